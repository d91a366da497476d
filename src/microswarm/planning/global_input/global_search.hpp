// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/global_input/global_search_params.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm::planning {

/// A plan and what it took.
struct GlobalSearch {
  GlobalPlan plan{};
  /// iterations: nodes expanded; samples: nodes made; edge_checks: inputs tried
  PlanCounts counts{};
  int rounds = 0;
};

/// Best-first search for inputs that bring robots to their goals under one input; beyond [global],
/// whose tree rarely solves three robots. An input is held until no robot moves any more, and every
/// configuration on the way where a robot reaches or leaves a wall is a node, so that walls and
/// corners are used on purpose. A node's cost is the error of the robots' relative positions, which
/// only walls can change, plus a small share of their common distance. Robots that have met at one
/// position can never be separated: this is no node unless the position serves both goals. Of the
/// configurations in one hypercube only the first is kept. That and a little noise in the costs
/// make the search fast and incomplete: after some nodes it restarts with other hypercubes, each
/// time a little later, and every other round measures the common distance around the walls instead
/// of straight. A pure function of its arguments. The status is start_blocked, goal_blocked,
/// solved, node_limit, stopped or time_limit; unless solved, the plan leads to the best
/// configuration found. Throws InputError as global_rrt does, and without goals.
GlobalSearch global_search(const Map& map, std::span<const Vec2> starts,
                           std::span<const Vec2> goals, const GlobalSearchParams& params, Rng& rng,
                           const Stop& stop = {});

}  // namespace microswarm::planning
