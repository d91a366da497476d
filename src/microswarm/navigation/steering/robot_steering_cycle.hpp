// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/steering/robot_delay_compensator.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm {

/// Counterpart of SteeringCycle for individually tracked robots under one input.
class RobotSteeringCycle {
 public:
  /// `robots`: their known properties; `tick` [s] between two commands. A frame older than
  /// `frame_timeout` [s] is ignored.
  RobotSteeringCycle(const RobotSwarmParams& robots, double tick, double frame_timeout)
      : robots_(robots), tick_(tick), frame_timeout_(frame_timeout) {}

  /// Call it once, before the first step.
  void prepare(const Snapshot& world);
  /// Begins a step: the robots when its command takes effect. Nothing when the step is to end with
  /// hold(): the frame is too old, shows a robot at no finite position, or none, or not `count`.
  std::optional<Robots> observe(const Observation& seen, std::optional<std::size_t> count = {});

  /// Ends a step without a move.
  Command hold(NavigatorState state = NavigatorState::blind) { return command({}, state); }
  /// Ends a step: records its command and state. Call it once per step.
  Command command(const Command& command, NavigatorState state);
  /// Ends a step with a move of all robots [µm] within the tick.
  Command move(Vec2 displacement, NavigatorState state) {
    return command(command_for(displacement, tick_), state);
  }

  /// Records a command that was given in place of a step; see Navigator::overruled.
  void overruled(double now, const Command& command) { compensator_->note(now, command); }

  const RobotSwarmParams& robots() const { return robots_; }
  /// Time between two commands [s].
  double tick() const { return tick_; }
  /// Maximum move in a tick [µm].
  double max_move() const { return robots_.max_speed * tick_; }
  /// Available after prepare().
  const Map& map() const { return compensator_->map(); }
  const RobotStepper& stepper() const { return compensator_->stepper(); }

  /// Data shown for the step, reset at its start.
  NavigatorView& view() { return view_; }
  const NavigatorView& view() const { return view_; }

 private:
  RobotSwarmParams robots_;
  double tick_;
  double frame_timeout_;
  double now_ = 0;
  std::optional<RobotDelayCompensator> compensator_;
  NavigatorView view_;
};

}  // namespace microswarm
