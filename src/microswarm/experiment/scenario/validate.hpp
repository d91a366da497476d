// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/config/former_keys.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm::experiment {

/// Note on a goal that is nearer to a wall than swarm and navigator allow: where the swarm is led
/// instead, and how far from it that is. A goal in a wall is an issue.
Notes goal_notes(const Scenario& scenario, const World& world);

/// Issues that make a run pointless: the start or the goal in a wall ("start is 12 µm inside wall
/// 3"), a swarm wider than every passage, a goal cut off from the start, no path with the
/// navigator's margin, or a navigator that could never move. Robots and their goals are checked
/// one by one. `is_given` returns whether the scenario sets a key.
Issues validate(const Scenario& scenario, const World& world, const IsGiven& is_given = {});

/// The path check alone: an issue if a swarm of `radius` [µm] cannot get from one free point of a
/// map to the other.
Issues validate_path(const Map& map, Vec2 start, Vec2 goal, double radius);

}  // namespace microswarm::experiment
