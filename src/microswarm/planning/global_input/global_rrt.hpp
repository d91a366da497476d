// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/global_input/global_rrt_params.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm::planning {

/// A grown tree and its answer for the goals it was grown with.
struct GlobalRrt {
  GoalAnswer answer{};
  GlobalTree tree{};
  PlanCounts counts{};
};

/// Grows the RRT under one input for all robots (Alg 1, 2 [global]). An extension applies the one
/// of k inputs that brings the robots nearest to a random free configuration; an input that moves
/// no robot adds no node. Without goals the tree grows to its limits, to be queried later. Pure
/// function of its arguments. The answer's status is start_blocked (no tree; also if robots are
/// closer than the separation), goal_blocked (only the root), solved, node_limit, or stopped or
/// time_limit if interrupted; its node is the best one found. Throws InputError if there are no
/// robots, more than max_global_robots, or a different number of goals.
GlobalRrt global_rrt(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                     const GlobalRrtParams& params, Rng& rng, const Stop& stop = {});

/// Fault of a query before planning: start_blocked (in a wall, or two robots closer than
/// `separation`), goal_blocked (no free point within the tolerance of a goal, or two goals too
/// close for the separation) or nothing.
std::optional<Status> robots_fault(const Map& map, std::span<const Vec2> starts,
                                   std::span<const Vec2> goals, double tolerance, double guard,
                                   double separation = 0);

}  // namespace microswarm::planning
