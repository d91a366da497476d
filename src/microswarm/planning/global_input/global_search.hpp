// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/global_input/global_search_params.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm {

/// A plan and what it took.
struct GlobalSearch {
  GlobalPlan plan;
  /// iterations: nodes expanded; samples: nodes made; edge_checks: inputs tried
  PlanCounts counts;
  int rounds = 0;
};

/// Best-first search for inputs that bring robots to their goals under one input; beyond [global],
/// whose tree seldom gets three robots anywhere. An input is held until nothing moves any more, and
/// every place on the way where a robot comes to a wall or leaves it is a node, so that walls and
/// corners are used on purpose. A node's cost is how wrong the robots stand to each other, which
/// walls alone can mend, and a little of the way they have to go together. Robots that have met at
/// one spot can never be parted again: unless a place serves both their goals, that is no node. Of
/// the configurations in one hypercube only the first is kept. That and a little noise in the costs
/// make it quick and incomplete: after some nodes it starts anew with other hypercubes, each time a
/// little later, and in every other round it measures the way together around the walls instead of
/// straight. A pure function of its arguments. The status is start_blocked, goal_blocked, solved,
/// node_limit, or stopped or time_limit when it was told to stop; the plan then leads to the best
/// configuration that was seen. Throws InputError as global_rrt does, and when there are no goals.
GlobalSearch global_search(const Map& map, std::span<const Vec2> starts,
                           std::span<const Vec2> goals, const GlobalSearchParams& params, Rng& rng,
                           const Stop& stop = {});

}  // namespace microswarm
