// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/common/detection.hpp"
#include "microswarm/planning/path/a_star.hpp"
#include "microswarm/planning/path/drrt_star.hpp"
#include "microswarm/planning/path/fmt_star.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "microswarm/planning/path/rrt.hpp"
#include "microswarm/planning/path/rrt_star.hpp"

namespace microswarm {

/// Every planner has one calling form, plan(world, start, goal, params, rng, stop). It is pure: the
/// same arguments and random stream give the same bits. A bad start or goal is a status, never an
/// exception; `stop` is asked at least once a millisecond.

/// Plans with any of them.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const PlannerParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm
