// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/issue.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

/// Issues when the run cannot be meant so: the start or the goal in a wall ("start is 12 µm inside
/// wall 3"), the swarm wider than every passage, the goal cut off from the start, no path that
/// keeps the navigator's margin, or a navigator that would never get on. Robots and their goals are
/// looked at one by one. `is_given` knows the scenario's keys.
Issues validate(const Scenario& scenario, const World& world, const IsGiven& is_given = {});

/// The part about the path: an issue when a swarm of `radius` [µm] does not get from one free point
/// of a map to the other.
Issues validate_path(const Map& map, Vec2 start, Vec2 goal, double radius);

}  // namespace microswarm
