// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/issue.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// The part of `validate` that is about a scenario's robots: how many, and what may stand beside
/// them.
Issues validate_robots(const Scenario& scenario);

/// The part that is about where they are.
Issues validate_robot_positions(const Scenario& scenario, const Map& map);

/// Issues when nothing can bring robots from `starts` to `goals`, one each: a start nearer than
/// `guard` [µm] to a wall, a goal in one, a goal cut off, or two robots in one place whose goals
/// are more than two tolerances [µm] apart. Keys are a scenario's.
Issues validate_robot_paths(const Map& map, std::span<const Vec2> starts,
                            std::span<const Vec2> goals, double tolerance, double guard);

}  // namespace microswarm
