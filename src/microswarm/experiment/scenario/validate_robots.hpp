// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::experiment {

/// The part of `validate` for a scenario's robots: their number and the keys allowed with them.
Issues validate_robots(const Scenario& scenario);

/// The part of `validate` for their positions.
Issues validate_robot_positions(const Scenario& scenario, const Map& map);

/// Issues that prevent robots from getting from `starts` to `goals`, one each: a start closer than
/// `guard` [µm] to a wall, a goal in a wall, a goal cut off, or two robots at the same position
/// whose goals are more than two tolerances [µm] apart. Keys are those of a scenario.
Issues validate_robot_paths(const Map& map, std::span<const Vec2> starts,
                            std::span<const Vec2> goals, double tolerance, double guard);

}  // namespace microswarm::experiment
