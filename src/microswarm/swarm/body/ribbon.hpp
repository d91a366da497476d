// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/swarm/body/lagging_commands.hpp"
#include "microswarm/swarm/body/ribbon_params.hpp"

namespace microswarm {

/// Maximum integration step of the ribbon [s].
inline constexpr double ribbon_substep = 0.01;

/// State of the ribbon model: pose and commands that have not taken effect yet. Holds until the
/// first command takes effect.
class Ribbon {
 public:
  Ribbon(const RibbonParams& params, Pose2 start);

  const Pose2& pose() const { return pose_; }
  /// Radius [µm] and commanded speed [µm/s].
  double radius() const { return params_.radius; }
  double speed() const { return active_.speed; }
  /// Advances time by `dt` seconds under `command`, which takes effect exactly `response_lag`
  /// later. Noise is drawn from `rng`.
  void step(const Command& command, double dt, Rng& rng);
  /// Trajectory of the last step, including its first and last pose; straight between poses, times
  /// [s] from the step's start. Empty before the first step.
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
