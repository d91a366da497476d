// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/infinity.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"

namespace microswarm {

/// Is there a swarm to steer in what is seen: a frame not older than `frame_timeout` [s], a world,
/// and a swarm at a place that is a number and in no wall?
bool sees_swarm(const Observation& seen, double frame_timeout);

/// What the steps of simple navigators for one body begin and end with:
///
///     if (const Pose2* pose = steering_.observe(seen)) return steering_.command({heading, speed},
///     "follow"); return steering_.hold();
///
/// It knows by its own commands where the swarm will be when the next one takes effect.
class SteeringCycle {
 public:
  SteeringCycle(const SwarmLimits& swarm, double speed, Vec2 goal, double goal_tolerance,
                double frame_timeout = default_frame_timeout);

  /// Once, before the first step: where to head for, `least` and if it can `wanted` [µm] away from
  /// the map's walls (see aim_at).
  void prepare(const Snapshot& world, double least, double wanted);
  /// As above, by its own limit.
  bool sees_swarm(const Observation& seen) const {
    return microswarm::sees_swarm(seen, frame_timeout_);
  }
  /// Where the swarm will be when the command of this step takes effect; null when it is to rest:
  /// there is none to see ("blind"), or it will be at the goal ("arrived").
  const Pose2* observe(const Observation& seen);
  /// The hold with which a step ends that began with null.
  Command hold() { return command({pose_.heading, 0}, why_hold_); }
  /// The command of this step and what it is for, in one word.
  Command command(const Command& command, NavigatorState state);

  const SwarmLimits& swarm() const { return swarm_; }
  /// As fast as it is wanted and can [µm/s].
  double speed() const { return speed_; }
  Vec2 goal() const { return goal_; }
  /// What to head for: the goal, or a point within its tolerance that is free.
  Vec2 aim() const { return aim_.position; }
  /// What it leaves of the goal's tolerance [µm].
  double aim_tolerance() const { return aim_.tolerance; }
  /// Is `p` within the goal's tolerance?
  bool arrives(Vec2 p) const { return distance(p, goal_) <= goal_tolerance_; }
  /// How far to stay from walls on the next `reach` µm from `p`, see Aim::wall_clearance [µm].
  double wall_clearance(double wanted, Vec2 p, double reach) const;
  /// From the frame to the effect of the command of this step [s].
  double delay() const { return delay_; }
  NavigatorView view() const { return view_; }
  /// What the commands given so far do; it forgets the old ones in observe().
  const DelayCompensator& compensator() const { return compensator_; }
  void show_target(Vec2 target) { view_.local_target = target; }

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
  Pose2 pose_;
  NavigatorState why_hold_ = NavigatorState::blind;
  NavigatorView view_;
};

}  // namespace microswarm
