// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/planning/a_star_params.hpp"
#include "microswarm/planning/drrt_star_params.hpp"
#include "microswarm/planning/fmt_star_params.hpp"
#include "microswarm/planning/rrt_params.hpp"

namespace microswarm {

/// Any planner, chosen at run time by its `type`.
using PlannerParams = std::variant<DrrtStarParams, RrtStarParams, UniformRrtStarParams, RrtParams,
                                   AStarParams, FmtStarParams>;

}  // namespace microswarm
