// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/planning/exact/exact_params.hpp"
#include "microswarm/planning/grid/grid_params.hpp"
#include "microswarm/planning/trees/drrt_star_params.hpp"
#include "microswarm/planning/trees/fmt_star_params.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// Any planner, selected at run time by its `type`; the first is the default.
using PlannerParams =
    std::variant<ExactParams, DrrtStarParams, RrtStarParams, UniformRrtStarParams, RrtParams,
                 RrtConnectParams, AStarParams, ThetaStarParams, FmtStarParams>;

}  // namespace microswarm::planning
