// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/swarm/body/lagging_commands.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm {

/// Robots as one body: centroid and root-mean-square distance from it. There must be at least one.
SwarmPose enclosing_pose(std::span<const Vec2> robots, double heading);

/// Simulated swarm of individually tracked robots.
class RobotSwarm {
 public:
  /// Keeps the stepper, which must belong to the swarm's map. The robots' relative speeds are drawn
  /// from `rng`: normal with mean 1, limited to 0.1 … 3.
  RobotSwarm(const RobotSwarmParams& params, RobotStepper stepper, std::span<const Vec2> starts,
             Rng& rng);

  const Robots& robots() const { return robots_; }
  /// Advances time by `dt` seconds under `command`, which takes effect `response_lag` later. Noise
  /// is drawn from `rng`. Identical robots move as in `RobotStepper::step`.
  void step(const Command& command, double dt, Rng& rng);

 private:
  void advance_each(const Command& command, double dt, Rng& rng);
  bool stuck(std::size_t robot, double dt, Rng& rng);

  RobotSwarmParams params_;
  RobotStepper stepper_;
  Robots robots_;
  std::vector<double> own_speed_;  // relative to the commanded speed
  std::vector<double> stuck_for_;  // [s]
  LaggingCommands commands_;
};

}  // namespace microswarm
