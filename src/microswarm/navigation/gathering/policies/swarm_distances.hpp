// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::navigation {

/// Path lengths of all robots to the goal and their mean F(n, t) [gather], updated for those robots
/// that moved.
class SwarmDistances {
 public:
  /// The map must outlive it.
  explicit SwarmDistances(const AggregationMap& map) : map_(&map) {}

  /// Takes the robots; `counts`, where given, is the number of robots at each position.
  void update(const Robots& robots, std::span<const std::uint32_t> counts);
  /// Takes the merging of positions: the new index of each old one. False where there are other
  /// positions than in the last update.
  bool remap(std::span<const std::uint32_t> new_positions);

  /// F(n, t) [µm] at the last update.
  double mean() const { return mean_; }
  /// Number of robots at the last update.
  double count() const { return count_; }
  /// The distance [µm] that must fall below σ.
  double left(Gathered measure) const;
  const RobotsOnMap& robots() const { return robots_; }

 private:
  const AggregationMap* map_;
  std::vector<float> x_;  ///< of each position at the last update
  std::vector<float> y_;
  RobotsOnMap robots_;
  double sum_ = 0;    ///< over all robots
  double count_ = 0;  ///< of robots
  double mean_ = 0;
};

}  // namespace microswarm::navigation
