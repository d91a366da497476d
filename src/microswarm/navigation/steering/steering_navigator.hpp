// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/decision.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"
#include "microswarm/navigation/steering/swarm_estimate.hpp"
#include "microswarm/navigation/steering/task.hpp"

namespace microswarm::navigation {

/// Base of the navigators of a single-body swarm: the cycle of a step. It holds without an observed
/// swarm and at the goal, compensates delays, and records every command and its state.
///
///     class Homing : public SteeringNavigator {
///       Decision decide(const Moment& now) override {
///         return {{heading_along(aim().position - now.pose.position), speed()},
///         NavigatorState::follow};
///       }
///     };
class SteeringNavigator : public Navigator {
 public:
  /// Why such a navigator cannot perform the task; empty if it can.
  static std::string_view unsupported_reason(const Task& task);

  Command step(const Observation& seen, const Stop& stop) final;
  void overruled(double now, const Command& command) override { record(now, command); }
  NavigatorView view() const final { return view_; }

 protected:
  /// A step in which a swarm is observed.
  struct Moment {
    const Observation& seen;
    Pose2 pose;  ///< at which the command of this step takes effect
    const Stop& stop;

    const Snapshot& world() const { return *seen.world; }
    const Map& map() const { return seen.world->map(); }
  };

  /// `task` must have a goal; `speed` [µm/s] is limited to the swarm's.
  SteeringNavigator(const Task& task, double speed);

  // The parts of a step, in this order.

  /// Processes every observation, also one without a swarm.
  virtual void update(const Observation& seen, const Stop& stop) { (void)seen, (void)stop; }
  /// Whether the observation shows a swarm to steer: a recent frame, a world, and a swarm whose
  /// pose is finite and in no wall.
  virtual bool sees_swarm(const Observation& seen) const;
  /// One of these three decides.
  virtual Decision decide(const Moment& moment) = 0;
  virtual Decision at_goal(const Moment&) { return hold(NavigatorState::arrived); }
  virtual Decision without_swarm() { return hold(NavigatorState::blind); }
  /// Completes the step's view, and may replace the decision.
  virtual Decision finish(const Decision& decision, const Observation& seen) {
    (void)seen;
    return decision;
  }

  /// From now on the pose is that of an estimate with this memory [s]; see SwarmEstimate. A swarm
  /// that frames miss is taken to have moved as commanded, until it has not been seen for the age
  /// above which a frame is too old. For a constructor.
  void estimate_swarm(double memory) { estimate_.emplace(memory, max_flow * speed_); }
  /// The estimate; null without it.
  const SwarmEstimate* estimate() const { return estimate_ ? &*estimate_ : nullptr; }
  /// Estimated response of the swarm to its commands. A decision is how it should move; the command
  /// that is given makes it do so.
  SwarmResponse response() const { return estimate_ ? estimate_->response() : SwarmResponse{}; }

  /// Chooses the aim, at least `least` and if possible `wanted` [µm] away from the map's walls; see
  /// aim_at. For prepare(); without it the aim is the goal.
  void choose_aim(const Snapshot& world, double least, double wanted);

  Decision hold(NavigatorState state = NavigatorState::hold) const {
    return {{pose_.heading, 0}, state};
  }
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
  double wall_clearance(double wanted, Vec2 p, double reach) const {
    return aim_.wall_clearance(swarm_.radius, wanted, p, reach);
  }
  /// Time from the frame until the command of this step takes effect [s].
  double delay() const { return delay_; }
  /// Age of a frame above which the navigator holds [s].
  double frame_timeout() const { return frame_timeout_; }
  /// Time of the last command [s]; nothing before the first.
  const std::optional<double>& last_command() const { return last_command_; }
  /// Effect of the commands given so far. A step with a swarm drops the old ones after update().
  DelayCompensator& compensator() { return compensator_; }
  /// Data shown for the step, reset at its start.
  NavigatorView& step_view() { return view_; }

 private:
  static constexpr double max_flow = 0.6;  // share of the speed

  Decision decision_for(const Observation& seen, const Stop& stop);
  Decision decision_at(const Observation& seen, const Stop& stop);
  bool misses_briefly(const Observation& seen) const;
  void record(double now, const Command& command);

  SwarmLimits swarm_;
  double speed_;
  Vec2 goal_;
  Aim aim_;
  double goal_tolerance_;
  double frame_timeout_;
  DelayCompensator compensator_;
  double delay_ = 0;
  std::optional<double> last_command_;
  std::optional<SwarmEstimate> estimate_;
  Pose2 pose_;
  NavigatorView view_;
};

}  // namespace microswarm::navigation
