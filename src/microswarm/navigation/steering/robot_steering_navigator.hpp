// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/steering/decision.hpp"
#include "microswarm/navigation/steering/robot_delay_compensator.hpp"
#include "microswarm/navigation/steering/task.hpp"

namespace microswarm::navigation {

/// Counterpart of SteeringNavigator for individually tracked robots under one input. It holds if
/// the frame is too old or shows a robot at no finite position, or not all of them.
class RobotSteeringNavigator : public Navigator {
 public:
  void prepare(const Snapshot& world, const Stop& stop) override;
  Command step(const Observation& seen, const Stop& stop) final;
  void overruled(double now, const Command& command) final { compensator_->note(now, command); }
  NavigatorView view() const final { return view_; }

 protected:
  /// `task` must have robots. A step needs `count` observed robots; without it, any.
  explicit RobotSteeringNavigator(const Task& task, std::optional<std::size_t> count = {});

  /// Decides at the time `now` [s] for the robots when the command takes effect.
  virtual Decision decide(const Robots& robots, double now, const Stop& stop) = 0;

  static Decision hold(NavigatorState state) { return {{}, state}; }
  /// Moves all robots [µm] within the tick.
  Decision move(Vec2 displacement, NavigatorState state) const {
    return {command_for(displacement, tick_), state};
  }
  const RobotSwarmParams& robots() const { return robots_; }
  double goal_tolerance() const { return goal_tolerance_; }
  /// Time between two commands [s].
  double tick() const { return tick_; }
  /// Maximum move in a tick [µm].
  double max_move() const { return robots_.max_speed * tick_; }
  /// Available after prepare().
  const Map& map() const { return compensator_->map(); }
  const RobotStepper& stepper() const { return compensator_->stepper(); }
  /// Data shown for the step, reset at its start.
  NavigatorView& step_view() { return view_; }

 private:
  bool sees_robots(const Observation& seen) const;

  RobotSwarmParams robots_;
  double goal_tolerance_;
  double tick_;
  double frame_timeout_;
  std::optional<std::size_t> count_;
  std::optional<RobotDelayCompensator> compensator_;
  NavigatorView view_;
};

}  // namespace microswarm::navigation
