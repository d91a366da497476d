// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/core/rng.hpp"
#include "microswarm/core/status.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/planning/gathering/node_lookup.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt_params.hpp"

namespace microswarm {

/// Ways to the goal, one a node. Every step from a node to its next is free.
struct Routes {
  std::vector<std::uint32_t> next;  ///< π: node to go to; the goal's is itself
  std::vector<double> cost;         ///< d⟨q, g⟩ in the measure that was minimised
  std::vector<double> length;       ///< [µm] along the way
};

/// Tree from the goal over the free space, and two ways to the goal from each of its nodes: along
/// the tree, and along the middle of the channels. Node 0 is the goal.
struct ObstacleWeightedRrt {
  Status status = Status::no_path;   ///< solved: as many nodes as asked for
  std::vector<Vec2> nodes;           ///< V
  std::size_t grown = 0;             ///< of them by Alg 1, the rest to complete it
  std::vector<Vec2> boundary;        ///< V_obs: where extensions met a wall
  std::vector<double> clearances;    ///< [µm] to the nearest point of V_obs
  std::vector<double> weights;       ///< w, Eq 3; the goal's is 0
  std::vector<std::uint8_t> medial;  ///< V*: 1 for the nodes near the middle, Eq 4
  double zeta_used = 0;  ///< ζ, raised just enough to join the pieces of V*; only at their necks
  Routes plain;          ///< Alg 1: next is the tree's parent, cost the length
  Routes weighted;       ///< Alg 2
  NodeLookup lookup;

  /// The node to start from at `p`: the nearest that is seen from about there. No allocation, some
  /// 10 ns. There must be nodes.
  std::uint32_t nearest(Vec2 p) const { return lookup.nearest(p, nodes); }
  /// The nearest node that `p` itself sees, exactly; nothing when none is seen close by. `map` is
  /// the one that the tree was grown in.
  std::optional<std::uint32_t> nearest_visible(const Map& map, Vec2 p) const {
    return lookup.nearest_visible(map, p, nodes);
  }
  /// Cost and length of the way from `p` by its nearest node.
  double cost(const Routes& routes, Vec2 p) const { return along(routes.cost, p); }
  double length(const Routes& routes, Vec2 p) const { return along(routes.length, p); }

 private:
  double along(const std::vector<double>& measure, Vec2 p) const {
    const std::uint32_t node = nearest(p);
    return distance(p, nodes[node]) + measure[node];
  }
};

/// Grows the tree and finds the routes (Alg 1, 2 [gather]). A pure function of its arguments. The
/// status is goal_blocked when the goal is not free (there are no nodes then), node_limit when the
/// samples ran out first, stopped or time_limit when it was told to stop; the routes are complete
/// for the nodes there are, but along the tree only when it was stopped.
ObstacleWeightedRrt obstacle_weighted_rrt(const Map& map, Vec2 goal,
                                          const ObstacleWeightedRrtParams& params, Rng& rng,
                                          const Stop& stop = {});

}  // namespace microswarm
