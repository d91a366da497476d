// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/planning/global_input/global_rrt_params.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm {

/// A grown tree and its answer to the goals it was grown with.
struct GlobalRrt {
  GoalAnswer answer;
  GlobalTree tree;
  PlanCounts counts;
};

/// Grows the tree of RRT under one input for all robots (Alg 1, 2 [global]): where the robots get
/// by the input of k that brings them nearest to a random free configuration; an input that moves
/// no robot adds no node. Without goals the tree grows to its limits, to be asked later. A pure
/// function of its arguments. The answer's status is start_blocked
/// (no tree then; robots nearer to each other than the separation are that too) or goal_blocked
/// (just the root), solved, node_limit, and stopped or time_limit
/// when it was told to stop; its node is the best there is. Throws InputError when there are no
/// robots, more than max_global_robots, or goals that are not as many.
GlobalRrt global_rrt(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                     const GlobalRrtParams& params, Rng& rng, const Stop& stop = {});

/// What is wrong before any planning: start_blocked (in a wall, or two robots nearer than
/// `separation`), goal_blocked (no free spot within the tolerance of a goal, or two goals so near
/// that no spots are far enough apart) or nothing.
std::optional<Status> robots_fault(const Map& map, std::span<const Vec2> starts,
                                   std::span<const Vec2> goals, double tolerance, double guard,
                                   double separation = 0);

}  // namespace microswarm
