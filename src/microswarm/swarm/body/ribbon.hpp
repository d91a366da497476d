// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/swarm/body/lagging_commands.hpp"
#include "microswarm/swarm/body/ribbon_params.hpp"

namespace microswarm {

/// Longest piece of time over which the ribbon is integrated at once [s].
inline constexpr double ribbon_substep = 0.01;

/// The moving part of the swarm model: pose and the commands that have not reached it yet. Before
/// the first command takes effect it holds.
class Ribbon {
 public:
  Ribbon(const RibbonParams& params, Pose2 start);

  const Pose2& pose() const { return pose_; }
  double radius() const { return params_.radius; }
  double speed() const { return active_.speed; }
  /// Lets `dt` seconds pass under `command`, which takes effect exactly `response_lag` later; noise
  /// is drawn from `rng`.
  void step(const Command& command, double dt, Rng& rng);
  /// The way of the last step, its first and last pose included: straight between them, times [s]
  /// counted from the step's start. Empty before the first step.
  std::span<const PoseStamped> trajectory() const { return trajectory_; }

 private:
  void advance(double dt, Rng& rng);

  RibbonParams params_;
  Pose2 pose_;
  Command active_;
  LaggingCommands commands_;
  std::vector<PoseStamped> trajectory_;
};

}  // namespace microswarm
