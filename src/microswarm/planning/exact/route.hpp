// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "microswarm/planning/exact/shortest_path_tree.hpp"

namespace microswarm::planning {

/// Shortest paths of a swarm to its goal from any position, also from positions with slightly less
/// than the clearance. Not thread-safe.
class Route {
 public:
  /// Without a path from any position.
  Route() = default;
  /// `clearance` [µm] from the walls of the map.
  Route(std::shared_ptr<const Map> map, Vec2 goal, double clearance,
        ShortestPathTree::Growth growth = ShortestPathTree::Growth::towards_queries)
      : map_(std::move(map)),
        clearance_(clearance),
        tree_(ShortestPathTree(*map_, goal, clearance, growth)) {}

  /// Sets the stop that ends a search, see ShortestPathTree.
  void stop_with(const Stop& stop) {
    if (tree_) tree_->stop_with(stop);
  }
  bool was_stopped() const { return tree_ && tree_->was_stopped(); }

  /// Length of the shortest path from `p` [µm], infinity without one.
  double length_from(Vec2 p);
  /// That path, from `p` on [µm]; empty without one.
  std::vector<Vec2> path_from(Vec2 p);
  /// Farthest point of that path, at most `reach` µm ahead, that is visible from `p` with nine
  /// tenths of the clearance, so that it moves on at a corner; `p` without a path.
  Vec2 ahead(Vec2 p, double reach);

 private:
  std::optional<Vec2> entry(Vec2 p) const;

  std::shared_ptr<const Map> map_;
  double clearance_ = 0;
  std::optional<ShortestPathTree> tree_;
};

}  // namespace microswarm::planning
