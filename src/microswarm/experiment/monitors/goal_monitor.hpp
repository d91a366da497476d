// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/monitors/robot_task.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Measures the remaining distance to a scenario's goal, of a swarm or of individually tracked
/// robots.
class GoalMonitor {
 public:
  /// The scenario must outlive the monitor.
  explicit GoalMonitor(const Scenario& scenario) : scenario_(&scenario) {}

  /// Takes the scenario's goal, also after a change; `from` is the swarm's position.
  void take_goal(Vec2 from);
  /// Measures robots from now on if the scenario has any; true at the first call after
  /// `take_goal`. The map must outlive the monitor.
  bool take_robots(const Map& map);

  /// Remaining distance [µm] of a swarm at `centre`, or of these robots.
  double left(Vec2 centre, std::span<const Vec2> robots);
  /// Whether the remaining distance is within the tolerance of the scenario.
  bool reached(double left) const { return left <= scenario_->goal_tolerance; }
  /// First time within the tolerance [s, on the clock of `trajectory`]; empty if never.
  std::optional<double> first_arrival(std::span<const PoseStamped> trajectory) const;
  /// Distance to the goal when it was taken [µm].
  double start_distance() const { return start_distance_; }
  bool has_robots() const { return task_.has_value(); }

 private:
  const Scenario* scenario_;
  std::optional<Vec2> goal_;  ///< goal at the time its distance was measured
  double start_distance_ = 0;
  std::optional<RobotTask> task_;
};

/// First time [s, on the clock of `trajectory`] within `tolerance` of the goal; empty if never.
std::optional<double> first_arrival(std::span<const PoseStamped> trajectory, Vec2 goal,
                                    double tolerance);

}  // namespace microswarm::experiment
