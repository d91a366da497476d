// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"

namespace microswarm {

/// Decision of a navigator in a step.
struct Decision {
  Command command;
  NavigatorState state = NavigatorState::hold;
};

/// Common step cycle of single-body navigators: hold without an observed swarm, delay compensation,
/// hold at the goal, and recording of the command and its state.
///
///     const Pose2* pose = steering_.observe(seen);
///     if (!pose) return steering_.hold();
///     return steering_.command({heading, speed}, NavigatorState::follow);
class SteeringCycle {
 public:
  SteeringCycle(const SwarmLimits& swarm, double speed, Vec2 goal, double goal_tolerance,
                double frame_timeout = default_frame_timeout);

  /// Call it once, before the first step. Chooses the aim, at least `least` and if possible
  /// `wanted` [µm] away from the map's walls (see aim_at).
  void prepare(const Snapshot& world, double least, double wanted);

  /// Whether the observation shows a swarm to steer: a recent frame, a world, and a swarm whose
  /// pose is finite and in no wall.
  bool sees_swarm(const Observation& seen) const;
  /// Starts a step; false if there is no swarm to steer.
  bool begin(const Observation& seen);
  /// Pose at which the command of this step takes effect; call it after begin().
  const Pose2& compensate(const Observation& seen);
  /// begin() and compensate(). Null if the step must end with hold(): no swarm, or the pose is at
  /// the goal.
  const Pose2* observe(const Observation& seen);

  /// Ends a step for which observe() returned null.
  Command hold() { return command({pose_.heading, 0}, why_hold_); }
  /// Ends a step: records its command and state. Call it once per step.
  Command command(const Command& command, NavigatorState state);
  Command command(const Decision& decision) { return command(decision.command, decision.state); }

  /// Records a command that was given in place of a step; see Navigator::overruled.
  void overruled(double now, const Command& command);

  const SwarmLimits& swarm() const { return swarm_; }
  /// Commanded speed, at most the swarm's [µm/s].
  double speed() const { return speed_; }
  Vec2 goal() const { return goal_; }
  double goal_tolerance() const { return goal_tolerance_; }
  /// Point to head for: the goal, or a free point within its tolerance.
  const Aim& aim() const { return aim_; }
  /// Whether `p` is within the goal's tolerance.
  bool arrives(Vec2 p) const { return distance(p, goal_) <= goal_tolerance_; }
  /// Clearance from walls to keep on the next `reach` µm from `p` [µm]; see Aim::wall_clearance.
  double wall_clearance(double wanted, Vec2 p, double reach) const;
  /// Time from the frame until the command of this step takes effect [s].
  double delay() const { return delay_; }
  /// Age of a frame above which the navigator holds [s].
  double frame_timeout() const { return frame_timeout_; }
  /// Time of the last command [s]; nothing before the first.
  const std::optional<double>& last_command() const { return last_command_; }
  /// Effect of the commands given so far; compensate() drops the old ones.
  DelayCompensator& compensator() { return compensator_; }

  /// Data shown for the step, reset at its start.
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
