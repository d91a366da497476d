// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "microswarm/contracts/command.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

/// One step of the unicycle model used by navigators and plants. It turns towards the commanded
/// heading by at most `turn_rate` · dt [rad], then moves straight along the mean of the old and the
/// new heading for speed · dt (Eq 6 [drrt] with the midpoint rule). Hold (speed 0) does not turn. A
/// swarm with infinite turn rate moves in the commanded direction at once: Eq 2 [radar].
inline Pose2 unicycle_step(const Pose2& pose, const Command& command, double turn_rate, double dt) {
  if (command.speed <= 0) return pose;
  if (std::isinf(turn_rate))
    return {pose.position + command.speed * dt * unit_vector(command.heading),
            wrap(command.heading)};
  const double turn =
      std::clamp(wrap(command.heading - pose.heading), -turn_rate * dt, turn_rate * dt);
  return {pose.position + command.speed * dt * unit_vector(pose.heading + 0.5 * turn),
          wrap(pose.heading + turn)};
}

/// Pose after `dt` [s] of a unicycle that turns at `turn_rate` [rad/s] until it has the commanded
/// heading and then goes straight: the limit of many short `unicycle_step`s.
inline Pose2 predict_unicycle(const Pose2& pose, const Command& command, double turn_rate,
                              double dt) {
  if (command.speed <= 0 || std::isinf(turn_rate))
    return unicycle_step(pose, command, turn_rate, dt);
  const double wanted = wrap(command.heading - pose.heading);
  const bool ends = std::abs(wanted) <= turn_rate * dt;
  const double turn = ends ? wanted : std::copysign(turn_rate * dt, wanted);
  const double turning = ends ? std::abs(wanted) / std::max(turn_rate, 1e-300) : dt;
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-4 ? 1 - half * half / 6 : maths::sin(half) / half;
  const double heading = wrap(pose.heading + turn);
  const Vec2 arc = chord * turning * unit_vector(pose.heading + half);
  return {pose.position + command.speed * (arc + (dt - turning) * unit_vector(heading)), heading};
}

}  // namespace microswarm
