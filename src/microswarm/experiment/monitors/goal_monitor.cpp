// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/monitors/goal_monitor.hpp"

#include "microswarm/geometry/distance.hpp"

namespace microswarm::experiment {

void GoalMonitor::take_goal(Vec2 from) {
  task_.reset();
  if (goal_ == scenario_->goal) return;
  goal_ = scenario_->goal;
  if (goal_) start_distance_ = distance(from, *goal_);
}

bool GoalMonitor::take_robots(const Map& map) {
  if (!scenario_->robots || task_) return false;
  task_.emplace(*scenario_, map);
  return true;
}

double GoalMonitor::left(Vec2 centre, std::span<const Vec2> robots) {
  return task_ ? task_->left(robots) : distance(centre, *scenario_->goal);
}

std::optional<double> GoalMonitor::first_arrival(std::span<const PoseStamped> trajectory) const {
  return microswarm::experiment::first_arrival(trajectory, *scenario_->goal,
                                               scenario_->goal_tolerance);
}

std::optional<double> first_arrival(std::span<const PoseStamped> trajectory, Vec2 goal,
                                    double tolerance) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const PoseStamped& a = trajectory[i > 0 ? i - 1 : 0];
    const PoseStamped& b = trajectory[i];
    const double share =
        first_contact(Segment{a.pose.position, b.pose.position}, tolerance, Disc{goal, 0});
    if (share <= 1) return a.t + share * (b.t - a.t);
  }
  return std::nullopt;
}

}  // namespace microswarm::experiment
