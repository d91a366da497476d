// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/monitors/robot_task.hpp"

#include <algorithm>

#include "microswarm/core/maths/hash.hpp"

namespace microswarm::experiment {

RobotTask::RobotTask(const Scenario& scenario, const Map& map) : goals_(scenario.robots->goals) {
  constexpr int cells = 512;
  if (!goals_.empty()) return;
  field_ = planning::DistanceField::over(map, *scenario.goal, cells);
  known_.resize(4096);
}

double RobotTask::remaining_from(Vec2 position) {
  Hash hash;
  hash.value(position.x), hash.value(position.y);
  Known& known = known_[hash.digest() % known_.size()];
  if (known.position != position) known = {position, field_->visible_estimate(position)};
  return known.remaining;
}

double RobotTask::left(std::span<const Vec2> robots) {
  double worst = 0;
  double sum = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const double remaining = field_ ? remaining_from(robots[i]) : distance(robots[i], goals_[i]);
    worst = std::max(worst, remaining);
    sum += remaining;
  }
  return field_ ? sum / static_cast<double>(robots.size()) : worst;
}

}  // namespace microswarm::experiment
