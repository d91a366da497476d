// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/robot_forecast.hpp"

#include <algorithm>

namespace microswarm {

namespace {

constexpr double same_moment = 1e-9;
constexpr double remembered = 60;  // [s] frames are never older

}  // namespace

RobotForecast::RobotForecast(RobotStepper stepper, ContactRule contact, double response_lag)
    : stepper_(std::move(stepper)), contact_(contact), lag_(response_lag) {}

Robots RobotForecast::at_effect(const Observation& observation) const {
  Robots robots = stepper_.place(observation.robots);
  const double end = observation.now + lag_;
  for (std::size_t i = 0; i < issued_.size(); ++i) {
    const double begins = std::max(issued_[i].time + lag_, observation.seen);
    const double ends = i + 1 < issued_.size() ? std::min(issued_[i + 1].time + lag_, end) : end;
    if (ends - begins > same_moment && issued_[i].command.speed > 0)
      stepper_.step(robots, displacement(issued_[i].command, ends - begins), contact_);
  }
  return robots;
}

void RobotForecast::issued(double now, const Command& command) {
  issued_.push_back({now, command});
  while (issued_.size() > 1 && issued_[1].time + lag_ < now - remembered) issued_.pop_front();
}

}  // namespace microswarm
