// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "microswarm/planning/exact/route.hpp"

namespace microswarm {

/// Lengths of the shortest paths to a goal from the nodes of a square grid, for many questions:
/// that of a node is found when it is first asked for. Not for several threads at once.
class DistanceField {
 public:
  static constexpr std::size_t max_exact_corners = 5'000;

  DistanceField() = default;
  /// Nodes `spacing` [µm] apart, one of them at the goal, for paths that keep `clearance` [µm]. A
  /// coarser grid where there would be more than `max_nodes`.
  static DistanceField to_goal(std::shared_ptr<const Map> map, Vec2 goal, double clearance,
                               double spacing, std::size_t max_nodes = 1'000'000);
  /// About `cells` × `cells` nodes over the map, for points. In maps of more than
  /// `max_exact_corners`, where the shortest paths from everywhere can take seconds, lengths along
  /// the edges of the grid: up to 8 % and a cell longer. `map` must outlive it.
  static DistanceField over(const Map& map, Vec2 goal, int cells = 128);

  /// What tells that a search for paths is to end; a length that it leaves open is asked for anew.
  void stop_with(const Stop& stop) { route_.stop_with(stop); }

  /// Length from the node next to `p` [µm], or the least of those around it where that one is in a
  /// wall; infinity without a path.
  double from(Vec2 p);
  /// Is there a path from the node next to `p`?
  bool reaches(Vec2 p) { return at(nearest(p)) < infinity; }
  /// Length from the node next to `p` [µm]; without a path the straight one and a detour around the
  /// map.
  double estimate(Vec2 p);
  /// The same by a node that `p` sees, also for points beside a wall.
  double visible_estimate(Vec2 p);
  /// See Route.
  Vec2 ahead(Vec2 p, double reach) { return route_.ahead(p, reach); }

 private:
  DistanceField(std::shared_ptr<const Map> map, Vec2 goal, double clearance, Vec2 low, double cell,
                double offset, ShortestPathTree::Growth growth);
  void spread();
  double at(std::size_t node);
  double straight_and_detour(Vec2 p) const { return distance(p, goal_) + detour_; }
  std::size_t nearest(Vec2 p) const;
  Vec2 position(std::size_t node) const;

  std::shared_ptr<const Map> map_;
  Route route_;
  Vec2 goal_;
  Vec2 low_;
  double cell_ = 1;
  double offset_ = 0;  ///< of the first node from `low_`, in cells
  double detour_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> lengths_;  ///< by node; negative until it is asked for
};

}  // namespace microswarm
