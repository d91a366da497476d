// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/places.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// The part of `check` that is about a scenario's robots: how many, and what may stand beside them.
void check_robots(const Scenario& scenario, const Places& where);

/// The part that is about where they are.
void check_robot_places(const Scenario& scenario, const Map& map, const Places& where);

/// Throws InputError when nothing can bring robots from `starts` to `goals`, one each: a start
/// nearer than `guard` [µm] to a wall, a goal in one, a goal cut off, or two robots in one place
/// whose goals are more than two tolerances [µm] apart. `where` knows the key
/// `robots` of a scenario.
void check_ways(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                double tolerance, double guard, const Places& where);

}  // namespace microswarm
