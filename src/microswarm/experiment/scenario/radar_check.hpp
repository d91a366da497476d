// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/places.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// The part of `check` that is about a radar's route and wait areas. Throws InputError when the
/// straight way between two given waypoints, or from the start to the first, or from the last to
/// the goal, crosses a wall; when a wait area is outside the map, has no valve in it, or asks of
/// one for a gap that it never opens to. A valve that moves counts as being in each.
void check_radar(const Scenario& scenario, const World& world, const Places& where);

}  // namespace microswarm
