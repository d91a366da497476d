// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// The part of `validate` for a radar's route and wait zones. Issues: a straight leg between start,
/// waypoints and goal crosses a wall; a wait zone is outside the map, contains no valve, or
/// requires a gap that its valve never reaches. A moving valve counts as being in every zone.
Issues validate_radar(const Scenario& scenario, const World& world);

/// The part of `validate` for the passages on the radar's way: an issue if all of them are narrower
/// than the distance that it keeps from walls. Start and goal must be free for the swarm.
Issues validate_radar_passages(const Scenario& scenario, const World& world);

}  // namespace microswarm::experiment
