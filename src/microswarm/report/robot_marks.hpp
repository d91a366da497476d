// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::report {

/// Whether each robot has its own colour.
bool are_few(const RobotSwarmParams& robots);
/// Colour of a robot: its own, or the common one.
Colour robot_colour(const RobotSwarmParams& robots, std::size_t robot);

/// Draws individually tracked robots at `positions` [µm]. Many are drawn as piles: robots that
/// would overlap are one spot, which grows with their number.
void draw_robot_marks(Picture& picture, const experiment::Scenario& scenario, const Box& bounds,
                      std::span<const Vec2> positions);
/// Draws the goal of all robots, or the goal of each with its tolerance.
void draw_robot_goals(Picture& picture, const experiment::Scenario& scenario);

}  // namespace microswarm::report
