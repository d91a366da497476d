// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/robot_task.hpp"

#include <algorithm>

namespace microswarm {

RobotTask::RobotTask(const Scenario& scenario, const Map& map)
    : map_(&map), goals_(scenario.robots->goals) {
  constexpr int cells = 512;
  if (goals_.empty()) way_.emplace(map, *scenario.goal, cells);
}

double RobotTask::left(std::span<const Vec2> robots) const {
  double worst = 0;
  double sum = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const double way = way_ ? way_->seen_from(*map_, robots[i]) : distance(robots[i], goals_[i]);
    worst = std::max(worst, way);
    sum += way;
  }
  return way_ ? sum / static_cast<double>(robots.size()) : worst;
}

}  // namespace microswarm
