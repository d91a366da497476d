// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/planning/path/drrt_star_params.hpp"
#include "microswarm/planning/path/exact_params.hpp"
#include "microswarm/planning/path/fmt_star_params.hpp"
#include "microswarm/planning/path/grid_params.hpp"
#include "microswarm/planning/path/rrt_params.hpp"

namespace microswarm {

/// Any planner, selected at run time by its `type`; the first unless told otherwise.
using PlannerParams =
    std::variant<ExactParams, DrrtStarParams, RrtStarParams, UniformRrtStarParams, RrtParams,
                 RrtConnectParams, AStarParams, ThetaStarParams, FmtStarParams>;

}  // namespace microswarm
