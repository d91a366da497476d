// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Global input: heading [rad] and speed [µm/s]. Speed 0 is hold.
struct Command {
  double heading = 0;
  double speed = 0;
};

/// Displacement [µm] that a command requests in `dt` seconds; exact along an axis.
inline Vec2 displacement(const Command& command, double dt) {
  constexpr double rounding = 1e-15;
  const Vec2 u = unit_vector(command.heading);
  const double length = command.speed * dt;
  return {std::abs(u.x) < rounding ? 0 : length * u.x, std::abs(u.y) < rounding ? 0 : length * u.y};
}

/// Command that requests the displacement `move` [µm] in `dt` seconds.
inline Command command_for(Vec2 move, double dt) { return {heading_along(move), norm(move) / dt}; }

}  // namespace microswarm
