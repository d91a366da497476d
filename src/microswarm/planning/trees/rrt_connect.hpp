// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// Plans with RRT-Connect; see planners.hpp for the common interface. The plan's tree is the one
/// that grows from the start, with the other's branch to the goal once they have met.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtConnectParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
