// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/trees/drrt_star_params.hpp"
#include "microswarm/planning/trees/rrt_star.hpp"

namespace microswarm::planning {

/// Plans with D-RRT*; see planners.hpp for the common interface.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
