// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/obstacles/body.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::rig {

/// Recognises detected bodies that are leaves of a valve by the scenario's positions of valves.
/// Moving valves are not recognised.
class ValveLeaves {
 public:
  /// `tolerance` [µm] is the maximum distance by which a leaf's image protrudes from its valve.
  ValveLeaves(std::span<const Obstacle> obstacles, double tolerance);

  /// Number of standing valves.
  std::uint32_t count() const { return static_cast<std::uint32_t>(valves_.size()); }
  /// Gives both leaves of the k-th valve the number k and moves them to the end, in a fixed order.
  /// A body across the middle of a valve is a closed one, and is cut there. A leaf seen alone keeps
  /// its number. Other bodies must have numbers from `count()` on.
  void join(std::vector<Body>& bodies) const;

 private:
  struct Standing {
    Vec2 at;     ///< [µm]
    Vec2 along;  ///< unit vector of its heading; the leaves lie across it
    double half_thickness;
    double half_span;
  };

  void join(const Standing& valve, std::uint32_t number, std::vector<Body>& bodies) const;

  std::vector<Standing> valves_;
  double tolerance_;
};

}  // namespace microswarm::rig
