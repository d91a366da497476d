// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/robot_steering_cycle.hpp"

#include <algorithm>

namespace microswarm {

void RobotSteeringCycle::prepare(const Snapshot& world) {
  compensator_.emplace(world.map(), max_move(), robots_.contact, robots_.response_lag);
}

std::optional<Robots> RobotSteeringCycle::observe(const Observation& seen,
                                                  std::optional<std::size_t> count) {
  view_ = {};
  now_ = seen.now;
  const bool is_complete = count ? seen.robots.size() == *count : !seen.robots.empty();
  if (!is_complete || seen.age() > frame_timeout_ || !std::ranges::all_of(seen.robots, is_finite))
    return std::nullopt;
  return compensator_->at_effect(seen);
}

Command RobotSteeringCycle::command(const Command& command, NavigatorState state) {
  view_.state = state;
  compensator_->note(now_, command);
  return command;
}

}  // namespace microswarm
