// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/step_to_waypoint.hpp"

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {

void StepToWaypoint::observe(std::size_t robot, Vec2 p) {
  held_ = robot == robot_ && p == position_ ? held_ + 1 : 0;
  robot_ = robot;
  position_ = p;
}

Vec2 StepToWaypoint::to(Vec2 waypoint) {
  constexpr double golden_angle = 2.399963229728653;
  waypoint_ = waypoint;
  const Vec2 left = waypoint_ - position_;
  const double length = norm(left);
  if (held_ <= 1) return std::min(1.0, step_ / std::max(length, 1e-12)) * left;
  const Vec2 move = length > 0 ? (step_ / length) * left : Vec2{step_, 0};
  return rotated(move, held_ * golden_angle);
}

}  // namespace microswarm::navigation
