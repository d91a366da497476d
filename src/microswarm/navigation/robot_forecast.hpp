// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <span>

#include "microswarm/swarm/robot_stepper.hpp"
#include "microswarm/swarm/robot_swarm.hpp"

namespace microswarm {

/// Where robots will be when the next command takes effect: those last seen, moved by the commands
/// that were given since and are still on their way.
class RobotForecast {
 public:
  RobotForecast(RobotStepper stepper, ContactRule contact, double response_lag);

  /// The robots at `now` + lag, from where they were `seen`.
  Robots at_effect(const Observation& observation) const;
  /// Notes that a command was given at `now` [s].
  void issued(double now, const Command& command);

  const RobotStepper& stepper() const { return stepper_; }
  ContactRule contact() const { return contact_; }

 private:
  struct Issued {
    double time;
    Command command;
  };
  RobotStepper stepper_;
  ContactRule contact_;
  double lag_;
  std::deque<Issued> issued_;
};

}  // namespace microswarm
