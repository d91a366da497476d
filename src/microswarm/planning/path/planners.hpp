// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/common/detection.hpp"
#include "microswarm/planning/exact/exact.hpp"
#include "microswarm/planning/grid/a_star.hpp"
#include "microswarm/planning/grid/theta_star.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "microswarm/planning/trees/drrt_star.hpp"
#include "microswarm/planning/trees/fmt_star.hpp"
#include "microswarm/planning/trees/rrt.hpp"
#include "microswarm/planning/trees/rrt_connect.hpp"
#include "microswarm/planning/trees/rrt_star.hpp"

namespace microswarm::planning {

/// Plans with the planner selected by `params`. All planners share this interface: plan(world,
/// start, goal, params, rng, stop). They are pure: the same arguments and random stream give the
/// same bits. A bad start or goal is a status, never an exception. `stop` is polled at least once
/// per millisecond.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const PlannerParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
