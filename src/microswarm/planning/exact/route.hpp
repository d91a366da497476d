// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "microswarm/planning/exact/shortest_path_tree.hpp"

namespace microswarm {

/// The shortest paths that lead a swarm to its goal from wherever it is, also from places that have
/// a little less than the clearance. Not for several threads at once.
class Route {
 public:
  /// No path from anywhere.
  Route() = default;
  /// `clearance` [µm] from the walls of the map.
  Route(std::shared_ptr<const Map> map, Vec2 goal, double clearance,
        ShortestPathTree::Growth growth = ShortestPathTree::Growth::towards_queries)
      : map_(std::move(map)),
        clearance_(clearance),
        tree_(ShortestPathTree(*map_, goal, clearance, growth)) {}

  /// See ShortestPathTree.
  void stop_with(const Stop& stop) {
    if (tree_) tree_->stop_with(stop);
  }
  bool was_stopped() const { return tree_ && tree_->was_stopped(); }

  /// Length of the shortest path from `p` [µm], infinity without one.
  double length_from(Vec2 p);
  /// The farthest point of that path, at most `reach` µm ahead, that is in sight of `p` past nine
  /// tenths of the clearance, so around a corner it is ahead too; `p` without a path.
  Vec2 ahead(Vec2 p, double reach);

 private:
  std::optional<Vec2> entry(Vec2 p) const;

  std::shared_ptr<const Map> map_;
  double clearance_ = 0;
  std::optional<ShortestPathTree> tree_;
};

}  // namespace microswarm
