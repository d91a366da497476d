// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// One solid piece at one moment: a connected wall piece or a moving obstacle.
struct Body {
  std::variant<Disc, Polygon> shape;
  Vec2 velocity{};                 ///< of its centre [µm/s]; zero for walls
  double deformation_speed = 0;    ///< bound on how fast its outline moves besides [µm/s]
  std::uint32_t obstacle = 0;      ///< which wall piece or obstacle it is (two leaves share one)
};

/// What a detection circle sees, for Eq 1–2 [drrt].
struct Survey {
  double covered_area = 0;   ///< circle ∩ obstacles [µm²], overlaps counted once
  int obstacles = 0;         ///< N: obstacles that meet the circle
  double distance_sum = 0;   ///< Σ d_min,i [µm]; 0 for one that holds the centre
};

/// A set of solid discs and polygons with exact queries. "Free with clearance r" means: no point of
/// the set is nearer than r, and for r = 0 not touching. Queries neither allocate nor change it.
class BodySet {
 public:
  BodySet() = default;
  explicit BodySet(std::vector<Body> bodies);
  /// Takes new bodies and keeps the buffers: moving obstacles do this at every tick.
  void assign(std::span<const Body> bodies);

  std::span<const Body> bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }

  /// Distance [µm] from `p` to the nearest body, 0 inside one, at most `limit`.
  double clearance(Vec2 p, double limit) const;
  /// Distance [µm] from the segment to the nearest body, 0 when they meet, at most `limit`.
  double clearance(Segment s, double limit) const;
  bool is_free(Vec2 p, double r) const;
  /// The whole capsule of radius r around s: exact, so that no thin wall is stepped over.
  bool is_free(Segment s, double r) const;
  /// Body that holds or is nearest to `p` within `limit`; bodies().size() when there is none.
  std::size_t nearest(Vec2 p, double limit) const;
  /// Adds what the circle sees of this set to `survey` (bodies of one obstacle count once).
  void survey(Disc circle, Survey& survey) const;

 private:
  std::vector<Body> bodies_;
  EdgeGrid edges_;
};

}  // namespace microswarm
