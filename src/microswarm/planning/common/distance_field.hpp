// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Distances to a goal along the free space of a static map: Dijkstra over a square grid of nodes,
/// eight neighbours each, every edge checked exactly. A distance is a guide, not a measure: it is
/// up to 8 % and some cells too long, and passages narrower than a cell may be missing. It never
/// leads through a wall.
class DistanceField {
 public:
  DistanceField() = default;
  /// Nodes `spacing` [µm] apart, one of them at the goal, whose edges keep `clearance` [µm]. A
  /// coarser grid where there would be more than `max_nodes`.
  static DistanceField to_goal(const Map& map, Vec2 goal, double clearance, double spacing,
                               std::size_t max_nodes = 1'000'000);
  /// About `cells` × `cells` nodes over the map, for points.
  static DistanceField over(const Map& map, Vec2 goal, int cells = 128);

  /// Distance [µm] from the node next to `p`, or the best of those around it where that one is in a
  /// wall; infinity without a path.
  double from(Vec2 p) const;
  /// Was a path to the goal found from the node next to `p`?
  bool reaches(Vec2 p) const;
  /// Distance [µm] from the node next to `p`; without a path the straight one and a detour around
  /// the map.
  double estimate(Vec2 p) const;
  /// The same by a node that `p` sees, also for points beside a wall. `map` is the field's.
  double visible_estimate(const Map& map, Vec2 p) const;
  /// The point of the path from `p` at most `reach` µm ahead that the straight line from `p`
  /// reaches with clearance `r`; `p` itself without a path.
  Vec2 ahead(const Map& map, Vec2 p, double reach, double r) const;

 private:
  DistanceField(const Map& map, Vec2 goal, Vec2 low, double cell, double offset);
  void spread(const Map& map, double clearance, std::size_t root, double root_distance);
  std::size_t nearest(Vec2 p) const;
  std::size_t nearest_reached(Vec2 p) const;
  Vec2 position(std::size_t node) const;

  Vec2 goal_;
  Vec2 low_;
  double cell_ = 1;
  double offset_ = 0;  ///< of the first node from `low_`, in cells
  double detour_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> distances_;  ///< by node; infinity without a path
  std::vector<std::uint32_t> next_;
};

}  // namespace microswarm
