// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// Plans with RRT; see planners.hpp for the common interface.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
