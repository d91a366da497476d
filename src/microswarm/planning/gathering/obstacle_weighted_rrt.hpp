// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/gathering/node_lookup.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt_params.hpp"

namespace microswarm::planning {

/// Routes from each node to the goal. Every step from a node to its next is collision-free.
struct Routes {
  std::vector<std::uint32_t> next{};  ///< π: next node; the goal is its own next
  std::vector<double> cost{};         ///< d⟨q, g⟩ in the measure that was minimised
  std::vector<double> length{};       ///< [µm] along the route
};

/// Tree from the goal over the free space, with two routes to the goal from each node: along the
/// tree, and along the middle of the channels. Node 0 is the goal.
struct ObstacleWeightedRrt {
  Status status = Status::no_path;     ///< solved: the requested number of nodes
  std::vector<Vec2> nodes{};           ///< V
  std::size_t grown = 0;               ///< number grown by Alg 1; the others complete the tree
  std::vector<Vec2> boundary{};        ///< V_obs: where extensions met a wall
  std::vector<double> clearances{};    ///< [µm] to the nearest point of V_obs
  std::vector<double> weights{};       ///< w, Eq 3; the goal's is 0
  std::vector<std::uint8_t> medial{};  ///< V*: 1 for nodes near the middle, Eq 4
  double zeta_used = 0;  ///< ζ, raised just enough at the necks to join the components of V*
  Routes plain{};        ///< Alg 1: next is the tree's parent, cost is the length
  Routes weighted{};     ///< Alg 2
  NodeLookup lookup{};

  /// Node to start from at `p`: the nearest one visible from the cell of `p`. No allocation, about
  /// 10 ns. There must be nodes.
  std::uint32_t nearest(Vec2 p) const { return lookup.nearest(p, nodes); }
  /// Nearest node visible from `p` itself, exact; nothing if none is visible close by. `map` is the
  /// one in which the tree was grown.
  std::optional<std::uint32_t> nearest_visible(const Map& map, Vec2 p) const {
    return lookup.nearest_visible(map, p, nodes);
  }
  /// Cost and length of the route from `p` through its nearest node.
  double cost(const Routes& routes, Vec2 p) const { return along(routes.cost, p); }
  double length(const Routes& routes, Vec2 p) const { return along(routes.length, p); }

 private:
  double along(const std::vector<double>& measure, Vec2 p) const {
    const std::uint32_t node = nearest(p);
    return distance(p, nodes[node]) + measure[node];
  }
};

/// Grows the tree and finds the routes (Alg 1, 2 [gather]). Pure function of its arguments. The
/// status is goal_blocked if the goal is not free (without nodes), node_limit if the samples ran
/// out, stopped or time_limit if interrupted. The routes are complete for the existing nodes; if
/// interrupted, only those along the tree.
ObstacleWeightedRrt obstacle_weighted_rrt(const Map& map, Vec2 goal,
                                          const ObstacleWeightedRrtParams& params, Rng& rng,
                                          const Stop& stop = {});

}  // namespace microswarm::planning
