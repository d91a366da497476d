// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// One global input: where to head [rad] and how fast [µm/s]. Speed 0 is hold.
struct Command {
  double heading = 0;
  double speed = 0;
};

/// The way [µm] that a command asks for in `dt` seconds; along an axis exactly.
inline Vec2 displacement(const Command& command, double dt) {
  constexpr double rounding = 1e-15;
  const Vec2 u = unit_vector(command.heading);
  const double length = command.speed * dt;
  return {std::abs(u.x) < rounding ? 0 : length * u.x, std::abs(u.y) < rounding ? 0 : length * u.y};
}

/// The command that asks for the way `move` [µm] in `dt` seconds.
inline Command command_for(Vec2 move, double dt) { return {heading_of(move), norm(move) / dt}; }

}  // namespace microswarm
