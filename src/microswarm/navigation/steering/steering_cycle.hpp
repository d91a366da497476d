// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/infinity.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"

namespace microswarm {

/// The life cycle that all navigators of one body share: no swarm to see → hold, compensation of
/// the delay, at the goal → hold, and the command noted with its state.
///
///     const Pose2* pose = steering_.observe(seen);
///     if (!pose) return steering_.hold();
///     return steering_.command({heading, speed}, NavigatorState::follow);
class SteeringCycle {
 public:
  SteeringCycle(const SwarmLimits& swarm, double speed, Vec2 goal, double goal_tolerance,
                double frame_timeout = default_frame_timeout);

  /// Once, before the first step: chooses the aim, `least` and if possible `wanted` [µm] away from
  /// the map's walls (see aim_at).
  void prepare(const Snapshot& world, double least, double wanted);

  /// Is there a swarm to steer in the observation: a frame that is not too old, a world, and a
  /// swarm whose pose is finite and in no wall?
  bool sees_swarm(const Observation& seen) const;
  /// Begins a step; false when there is no swarm to steer.
  bool begin(const Observation& seen);
  /// The pose at which the command of this step takes effect; after begin().
  const Pose2& compensate(const Observation& seen);
  /// All of this. Null when the step is to end with hold(): no swarm, or the pose is at the goal.
  const Pose2* observe(const Observation& seen);

  /// Ends a step for which observe() returned null.
  Command hold() { return command({pose_.heading, 0}, why_hold_); }
  /// Ends a step: notes its command and state. Once a step.
  Command command(const Command& command, NavigatorState state);

  const SwarmLimits& swarm() const { return swarm_; }
  /// The commanded speed, at most the swarm's [µm/s].
  double speed() const { return speed_; }
  Vec2 goal() const { return goal_; }
  double goal_tolerance() const { return goal_tolerance_; }
  /// The point to head for: the goal, or a free point within its tolerance.
  const Aim& aim() const { return aim_; }
  /// Is `p` within the goal's tolerance?
  bool arrives(Vec2 p) const { return distance(p, goal_) <= goal_tolerance_; }
  /// Clearance to keep from walls on the next `reach` µm from `p`, see Aim::wall_clearance [µm].
  double wall_clearance(double wanted, Vec2 p, double reach) const;
  /// From the frame to the effect of this step's command [s].
  double delay() const { return delay_; }
  /// Age of a frame above which the navigator holds [s].
  double frame_timeout() const { return frame_timeout_; }
  /// When the last command was given [s]; nothing before the first.
  const std::optional<double>& last_command() const { return last_command_; }
  /// What the commands given so far do; compensate() forgets the old ones.
  DelayCompensator& compensator() { return compensator_; }

  /// What the step shows, empty at its beginning.
  NavigatorView& view() { return view_; }
  const NavigatorView& view() const { return view_; }

 private:
  SwarmLimits swarm_;
  double speed_;
  Vec2 goal_;
  Aim aim_;
  double goal_tolerance_;
  double frame_timeout_;
  DelayCompensator compensator_;
  double now_ = 0;
  double delay_ = 0;
  std::optional<double> last_command_;
  Pose2 pose_;
  NavigatorState why_hold_ = NavigatorState::blind;
  NavigatorView view_;
};

}  // namespace microswarm
