// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/planning/path/planner_params.hpp"

namespace microswarm::planning {

/// Parameters for a path across a whole map. Lengths that are not given follow from the typical
/// channel width, as the defaults fit the channel of Fig 3 [drrt]; limits of nodes and iterations
/// from the size of the map in steps. Neither the clearance nor a turn's radius is changed, which
/// are the swarm's, and the tolerance only falls. Where the map's corners lie on a lattice, grids
/// and samples follow it (corner_lattice.hpp). A map without free space changes nothing.
/// `is_given` returns whether a key of the planner is given.
PlannerParams fit_to_map(PlannerParams params, const Map& map, const IsGiven& is_given);

/// The limit that ended a search with the status node_limit: "planner.max_nodes is 5000".
std::string limit_text(const PlannerParams& params, const PlanCounts& counts);

}  // namespace microswarm::planning
