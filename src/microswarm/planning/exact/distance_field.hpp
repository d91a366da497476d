// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "microswarm/planning/exact/route.hpp"

namespace microswarm::planning {

/// Lengths of the shortest paths to a goal from the nodes of a square grid. The length of a node is
/// computed at the first query and kept. Not thread-safe.
class DistanceField {
 public:
  static constexpr std::size_t max_exact_corners = 5'000;

  DistanceField() = default;
  /// Nodes `spacing` [µm] apart, one of them at the goal, for paths that keep `clearance` [µm]. The
  /// grid is coarsened to at most `max_nodes` nodes.
  static DistanceField to_goal(std::shared_ptr<const Map> map, Vec2 goal, double clearance,
                               double spacing, std::size_t max_nodes = 1'000'000);
  /// About `cells` × `cells` nodes over the map, without clearance. In maps of more than
  /// `max_exact_corners`, where exact lengths can take seconds, lengths along the edges of the
  /// grid: up to 8 % and one cell longer. `map` must outlive the field.
  static DistanceField over(const Map& map, Vec2 goal, int cells = 128);

  /// Sets the stop that ends a search. A length that an ended search did not find is not kept.
  void stop_with(const Stop& stop) { route_.stop_with(stop); }

  /// Path length from the node nearest to `p` [µm], or the minimum of the nodes around it if that
  /// node is in a wall; infinity without a path.
  double from(Vec2 p);
  /// Whether there is a path from the node nearest to `p`.
  bool reaches(Vec2 p) { return at(nearest(p)) < infinity; }
  /// Path length from the node nearest to `p` [µm]; without a path, the straight distance plus a
  /// detour around the map.
  double estimate(Vec2 p);
  /// The same [µm] over a node that is visible from `p`, which also serves points beside a wall.
  double visible_estimate(Vec2 p);
  /// Point of the path at most `reach` µm ahead, see Route::ahead.
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
  double offset_ = 0;  ///< of the first node from `low_` [cells]
  double detour_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> lengths_;  ///< of each node [µm]; negative until computed
};

}  // namespace microswarm::planning
