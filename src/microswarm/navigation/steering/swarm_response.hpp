// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "microswarm/contracts/command.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/planning/space_time/turn_first.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm::navigation {

/// Response of a single-body swarm to commands: it is `speed_factor` times as fast, and carried by
/// a flow.
struct SwarmResponse {
  double speed_factor = 1;
  Vec2 flow{};  ///< [µm/s]

  bool operator==(const SwarmResponse&) const = default;

  /// The command with which it moves as `wanted`: on its course if `max_speed` [µm/s] allows that,
  /// and as fast as it allows. Holding stays holding, and a swarm that turns first turns to the
  /// heading with which it moves at full speed.
  Command command_for(const Command& wanted, double max_speed) const {
    if (wanted.speed == 0 || *this == SwarmResponse{}) return wanted;
    if (planning::TurnFirst::is_turn(wanted.speed, max_speed))
      return {command_for({wanted.heading, max_speed}, max_speed).heading, wanted.speed};
    const Vec2 course = unit_vector(wanted.heading);
    Vec2 own = (wanted.speed * course - flow) / speed_factor;
    if (norm(own) > max_speed) {
      const Vec2 across = own - dot(own, course) * course;
      const double left = max_speed * max_speed - squared_norm(across);
      own = left > 0 ? across + std::sqrt(left) * course : (max_speed / norm(own)) * own;
    }
    if (own == Vec2{}) return {wanted.heading, 0};
    return {heading_along(own), std::min(norm(own), max_speed)};
  }
  /// Position after `dt` [s] in which commands alone would have moved it by `commanded` [µm].
  Vec2 moved(Vec2 from, Vec2 commanded, double dt) const {
    if (*this == SwarmResponse{}) return from + commanded;
    return from + speed_factor * commanded + dt * flow;
  }
  /// Its pose after `dt` [s] with a command, see predict_unicycle.
  Pose2 step(const Pose2& pose, const Command& command, double turn_rate, double dt) const {
    Pose2 next = predict_unicycle(pose, command, turn_rate, dt);
    if (!(*this == SwarmResponse{}))
      next.position = moved(pose.position, next.position - pose.position, dt);
    return next;
  }
};

}  // namespace microswarm::navigation
