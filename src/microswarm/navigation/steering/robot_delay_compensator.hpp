// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <span>

#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm::navigation {

/// Predicts the robots' positions when the next command takes effect: the last observed positions,
/// moved by the commands given since and not yet in effect.
class RobotDelayCompensator {
 public:
  /// `reach` [µm] is the robots' move per command.
  RobotDelayCompensator(const Map& map, double reach, ContactRule contact, double response_lag);

  /// Robots at `now` + lag, from their positions at `seen`. A robot observed in a wall, which an
  /// error below a pixel can cause, is moved beside it.
  Robots at_effect(const Observation& observation) const;
  /// Records a command given at `now` [s].
  void note(double now, const Command& command);

  const Map& map() const { return map_; }
  const RobotStepper& stepper() const { return stepper_; }
  ContactRule contact() const { return contact_; }

 private:
  struct Issued {
    double time;
    Command command;
  };
  Map map_;
  RobotStepper stepper_;
  ContactRule contact_;
  double lag_;
  std::deque<Issued> issued_;
};

}  // namespace microswarm::navigation
