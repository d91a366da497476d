// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/swarm/body/lagging_commands.hpp"
#include "microswarm/swarm/body/vortex_params.hpp"

namespace microswarm {

/// Maximum radius [µm].
double max_radius(const VortexParams& params);
/// Minimum radius [µm].
double min_radius(const VortexParams& params);

/// Pitch φ [rad] of a command, at most max_pitch: Eq 2 [radar].
double helix_pitch(const VortexParams& params, const Command& command);

/// The moving part of the model. Before the first command takes effect it holds.
class Vortex {
 public:
  Vortex(const VortexParams& params, Pose2 start);

  const Pose2& pose() const { return pose_; }
  /// Current radius [µm] and commanded speed [µm/s].
  double radius() const { return radius_; }
  double speed() const { return active_.speed; }
  /// Advances time by `dt` seconds under `command`, which takes effect exactly `response_lag`
  /// later. Noise is drawn from `rng`.
  void step(const Command& command, double dt, Rng& rng);
  /// Trajectory of the last step, as in Ribbon::trajectory.
  std::span<const PoseStamped> trajectory() const { return trajectory_; }

 private:
  void advance(double dt, Rng& rng);
  void breathe(double dt, Rng& rng);

  VortexParams params_;
  Pose2 pose_;
  double radius_;
  Command active_;
  LaggingCommands commands_;
  std::vector<PoseStamped> trajectory_;
};

}  // namespace microswarm
