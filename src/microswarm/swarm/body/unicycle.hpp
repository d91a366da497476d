// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "microswarm/contracts/command.hpp"
#include "microswarm/core/maths/angles.hpp"

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

}  // namespace microswarm
