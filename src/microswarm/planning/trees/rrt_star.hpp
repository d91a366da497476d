// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/trees/rrt.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// Plans with RRT* or uniform RRT*; see planners.hpp for the common interface.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtStarParams& params, Rng& rng,
          const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const UniformRrtStarParams& params,
          Rng& rng, const Stop& stop = {});

}  // namespace microswarm::planning
