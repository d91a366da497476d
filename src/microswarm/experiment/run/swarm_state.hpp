// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/experiment/monitors/goal_monitor.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Current state of the swarm: the ground truth if the plant provides it, else the last
/// observation.
class SwarmState {
 public:
  struct Values {
    double t = 0;                     ///< [s]
    Pose2 pose{};                     ///< of the swarm, or of the robots' centre
    double radius = 0;                ///< of a swarm, 0 of robots [µm]
    double speed = 0;                 ///< [µm/s]
    double goal_distance = infinity;  ///< [µm]
  };

  /// Both must outlive it.
  SwarmState(const Scenario& scenario, const Plant& plant);

  /// Has `goal` measure robots from now on if there are any. At the first call for a goal it takes
  /// their position.
  void take_robots(const Observation& seen, GoalMonitor& goal);
  /// Takes the state at an observation; `goal` measures the distance left.
  void take(const Observation& seen, GoalMonitor& goal);
  /// Takes the state within a tick.
  void take(const Values& values) { now_ = values; }
  const Values& now() const { return now_; }

  /// Takes what an observation detects; whether the number of undetected robots has changed.
  bool take_sight(const Observation& seen);
  /// Whether the swarm was seen at least once, or its ground truth is known.
  bool was_seen() const { return was_seen_; }
  /// Robots that a rig does not detect; they may be anywhere. 0 with ground truth.
  int unseen() const { return unseen_; }

  /// Positions of the robots now.
  std::span<const Vec2> robots(const Observation& seen) const;
  /// World at the time of the state.
  Snapshot world(const Observation& seen) const;

 private:
  const Scenario& scenario_;
  const Plant& plant_;
  Values now_;
  std::optional<double> seen_at_;  // time of the last observed pose [s]
  bool was_seen_ = false;
  int unseen_ = 0;
};

}  // namespace microswarm::experiment
