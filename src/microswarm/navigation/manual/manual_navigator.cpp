// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/manual/manual_navigator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace microswarm::navigation {

void ManualNavigator::steer(const Command& command) {
  const std::lock_guard lock(mutex_);
  const bool is_sound = std::isfinite(command.heading) && std::isfinite(command.speed);
  next_ = is_sound ? Command{command.heading, std::clamp(command.speed, 0.0, max_speed_)}
                   : Command{heading_, 0};
}

void ManualNavigator::release() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  command_.reset();
}

Command ManualNavigator::step(const Observation& seen, const Stop&) {
  const std::lock_guard lock(mutex_);
  view_ = {.state = NavigatorState::manual};
  if (next_) {
    command_ = std::exchange(next_, std::nullopt);
    since_ = seen.now;
    heading_ = command_->heading;
  }
  constexpr double same_moment = 1e-9;  // [s]
  if (seen.now - since_ > duration_ - same_moment) command_.reset();
  if (command_) return *command_;
  return {seen.swarm ? seen.swarm->pose.heading : heading_, 0};
}

}  // namespace microswarm::navigation
