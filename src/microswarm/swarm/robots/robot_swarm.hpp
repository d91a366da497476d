// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/swarm/body/lagging_commands.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm {

/// Robots as one body: their middle, and how far they are from it (root mean square). There is one
/// at least.
SwarmPose body_of(std::span<const Vec2> robots, double heading);

/// The moving part of that model.
class RobotSwarm {
 public:
  /// Keeps the stepper, which the swarm's map was made for. The robots' own speeds are drawn from
  /// `rng`: normal about 1, from 0.1 to 3.
  RobotSwarm(const RobotSwarmParams& params, RobotStepper stepper, std::span<const Vec2> starts,
             Rng& rng);

  const Robots& robots() const { return robots_; }
  /// Lets `dt` seconds pass under `command`, which takes effect `response_lag` later; noise is
  /// drawn from `rng`. Robots that are all alike move as `RobotStepper::step` moves them.
  void step(const Command& command, double dt, Rng& rng);

 private:
  void advance_each(const Command& command, double dt, Rng& rng);
  bool stuck(std::size_t robot, double dt, Rng& rng);

  RobotSwarmParams params_;
  RobotStepper stepper_;
  Robots robots_;
  std::vector<double> own_speed_;  // share of the commanded one
  std::vector<double> stuck_for_;  // [s]
  LaggingCommands commands_;
};

}  // namespace microswarm
