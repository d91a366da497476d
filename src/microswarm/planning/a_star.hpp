// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/planning/a_star_params.hpp"
#include "microswarm/planning/plan.hpp"

namespace microswarm {

/// Plans with A*; see planners.hpp for the form that all planners share.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm
