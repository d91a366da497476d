// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/issue.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// The part of `validate` that is about a radar's route and wait areas: issues when the straight
/// way between two given waypoints, or from the start to the first, or from the last to the goal,
/// crosses a wall; when a wait area is outside the map, has no valve in it, or asks of one for a
/// gap that it never opens to. A valve that moves counts as being in each.
Issues validate_radar(const Scenario& scenario, const World& world);

}  // namespace microswarm
