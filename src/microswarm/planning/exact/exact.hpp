// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/planning/exact/exact_params.hpp"

namespace microswarm {

/// Plans the shortest path to the goal itself or, if that is blocked, to a free place next to it;
/// see planners.hpp for the common interface. The corners of the map are found by the first plan in
/// it and kept with the map. Arcs are drawn by lines that touch them, 0.1 % longer at most. The
/// status no_path means that there is none to that place.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ExactParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm
