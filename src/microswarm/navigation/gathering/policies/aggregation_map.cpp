// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"

#include <algorithm>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::navigation {

AggregationMap::AggregationMap(Map m, Vec2 goal, const AggregationParams& params, Rng& rng,
                               MoveRule rule, const Stop& stop)
    : map(std::move(m)),
      tree(planning::obstacle_weighted_rrt(map, goal, params.tree, rng, stop)),
      obstacle_weighted(params.obstacle_weighted) {
  if (tree.status == Status::goal_blocked) throw InputError("goal is not free");
  was_stopped = stop();
  if (was_stopped) return;
  if (tree.status != Status::solved)
    throw InputError("the tree has " + std::to_string(tree.nodes.size()) + " nodes after " +
                     std::to_string(params.tree.max_iterations) + " samples, " +
                     std::to_string(params.tree.nodes) + " were asked for");
  segmentation = planning::segment_map(map, tree, routes(), params.segmentation, stop);
  was_stopped = stop();
  if (was_stopped) return;
  longest = *std::ranges::max_element(routes().length);
  if (rule == MoveRule::any_direction) return;
  cells = std::make_shared<const CellGraph>(map, params.step, CellSteps::hops);
  hops = cells->distances(cells->nearest(map, goal));
}

}  // namespace microswarm::navigation
