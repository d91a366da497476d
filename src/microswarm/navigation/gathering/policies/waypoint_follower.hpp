// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"
#include "microswarm/navigation/gathering/policies/step_to_waypoint.hpp"

namespace microswarm::navigation {

/// Leads one robot at a time to the goal along the tree, from visible node to visible node; by
/// the cell rule, along the shortest path from cell to cell.
class WaypointFollower {
 public:
  /// `step` [µm] is the length of a move. The map must outlive it.
  WaypointFollower(const AggregationMap& map, double step)
      : map_(&map), step_(step), step_to_(step) {}

  /// The move [µm] for leader `robot` of `count` robots, which is at `p`.
  Vec2 move(std::size_t robot, std::size_t count, Vec2 p);
  /// Takes the merging of positions: the new index of each old one.
  void remap(std::span<const std::uint32_t> new_positions);

  /// The point that the last move leads to.
  Vec2 waypoint() const { return step_to_.waypoint(); }

 private:
  Vec2 next_waypoint(std::size_t robot, Vec2 p);

  const AggregationMap* map_;
  double step_;
  std::vector<std::uint32_t> node_of_;  ///< node that each robot was last led to
  StepToWaypoint step_to_;
};

}  // namespace microswarm::navigation
