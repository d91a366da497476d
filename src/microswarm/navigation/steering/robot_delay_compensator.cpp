// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/robot_delay_compensator.hpp"

#include <algorithm>
#include <vector>

#include "microswarm/world/connectivity/free_place.hpp"

namespace microswarm::navigation {

namespace {

constexpr double same_moment = 1e-9;
constexpr double remembered = 60;  // [s] upper bound of the age of a frame

}  // namespace

RobotDelayCompensator::RobotDelayCompensator(const Map& map, double reach, ContactRule contact,
                                             double response_lag)
    : map_(map), stepper_(map, reach), contact_(contact), lag_(response_lag) {}

Robots RobotDelayCompensator::at_effect(const Observation& observation) const {
  std::vector<Vec2> positions(observation.robots.begin(), observation.robots.end());
  const double guard = stepper_.guard();
  for (Vec2& position : positions)
    if (!map_.is_free(position, guard / 2)) position = free_place(map_, position, 2 * guard);
  Robots robots = stepper_.place(positions);
  const double end = observation.now + lag_;
  for (std::size_t i = 0; i < issued_.size(); ++i) {
    const double begins = std::max(issued_[i].time + lag_, observation.seen);
    const double ends = i + 1 < issued_.size() ? std::min(issued_[i + 1].time + lag_, end) : end;
    if (ends - begins > same_moment && issued_[i].command.speed > 0)
      stepper_.step(robots, displacement(issued_[i].command, ends - begins), contact_);
  }
  return robots;
}

void RobotDelayCompensator::note(double now, const Command& command) {
  issued_.push_back({now, command});
  while (issued_.size() > 1 && issued_[1].time + lag_ < now - remembered) issued_.pop_front();
}

}  // namespace microswarm::navigation
