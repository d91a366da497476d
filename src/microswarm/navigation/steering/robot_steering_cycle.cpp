// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/robot_steering_cycle.hpp"

namespace microswarm {

void RobotSteeringCycle::prepare(const Snapshot& world) {
  compensator_.emplace(world.map(), max_move(), robots_.contact, robots_.response_lag);
}

std::optional<Robots> RobotSteeringCycle::observe(const Observation& seen,
                                                  std::optional<std::size_t> count) {
  view_ = {};
  now_ = seen.now;
  const bool sees_robots = count ? seen.robots.size() == *count : !seen.robots.empty();
  if (!sees_robots || seen.age() > frame_timeout_) return std::nullopt;
  return compensator_->at_effect(seen);
}

Command RobotSteeringCycle::command(const Command& command, NavigatorState state) {
  view_.state = state;
  compensator_->note(now_, command);
  return command;
}

}  // namespace microswarm
