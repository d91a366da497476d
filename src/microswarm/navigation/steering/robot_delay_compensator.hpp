// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <span>

#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm {

/// Where robots will be when the next command takes effect: those last seen, moved by the commands
/// that were given since and are still on their way.
class RobotDelayCompensator {
 public:
  /// `reach` [µm] is what the robots go in one command.
  RobotDelayCompensator(const Map& map, double reach, ContactRule contact, double response_lag);

  /// The robots at `now` + lag, from where they were `seen`. A robot seen in a wall, as errors of
  /// less than a pixel suffice for, is taken to be beside it.
  Robots at_effect(const Observation& observation) const;
  /// Notes that a command was given at `now` [s].
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

}  // namespace microswarm
