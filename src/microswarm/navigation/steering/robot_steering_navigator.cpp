// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/robot_steering_navigator.hpp"

#include <algorithm>

namespace microswarm::navigation {

RobotSteeringNavigator::RobotSteeringNavigator(const Task& task, std::optional<std::size_t> count)
    : robots_(*task.robots),
      goal_tolerance_(task.goal_tolerance),
      tick_(task.tick),
      frame_timeout_(task.frame_timeout),
      count_(count) {}

void RobotSteeringNavigator::prepare(const Snapshot& world, const Stop&) {
  compensator_.emplace(world.map(), max_move(), robots_.contact, robots_.response_lag);
}

Command RobotSteeringNavigator::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  const Decision decision = sees_robots(seen)
                                ? decide(compensator_->at_effect(seen), seen.now, stop)
                                : hold(NavigatorState::blind);
  view_.state = decision.state;
  compensator_->note(seen.now, decision.command);
  return decision.command;
}

bool RobotSteeringNavigator::sees_robots(const Observation& seen) const {
  const bool is_complete = count_ ? seen.robots.size() == *count_ : !seen.robots.empty();
  return is_complete && seen.age() <= frame_timeout_ && std::ranges::all_of(seen.robots, is_finite);
}

}  // namespace microswarm::navigation
