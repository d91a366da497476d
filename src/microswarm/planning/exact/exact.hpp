// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/planning/exact/exact_params.hpp"

namespace microswarm::planning {

/// Plans the shortest path to the goal or, if the goal is blocked, to a free point next to it;
/// see planners.hpp for the common interface. The first plan in a map finds its corners, which are
/// kept with the map. Arcs are replaced by tangent lines, at most 0.1 % longer. The status no_path
/// is a proof: there is no path to that point.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ExactParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
