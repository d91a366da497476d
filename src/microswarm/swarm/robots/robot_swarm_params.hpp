// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/swarm/robots/contact_rule.hpp"

namespace microswarm {

/// Swarm of individually tracked robots: points that all receive the same input and do not block
/// each other [global, gather]. Robots on a real rig differ, so each can have its own speed,
/// heading noise and drift, and occasionally stick to the floor.
struct RobotSwarmParams {
  int count = 0;
  std::vector<Vec2> starts{};
  std::vector<Vec2> goals{};
  ContactRule contact = ContactRule::stop;
  double max_speed = 80;
  double speed_spread = 0;
  double heading_noise = 0;
  double position_noise = 0;
  double sticking_interval = 0;
  double sticking_time = 5;
  double response_lag = 0.1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.count,
          plain("count", 0, 1e6, "Robots at random starts that reach the goal; 0: `starts_um`."));
    visit(self.starts, um("starts", "Start of each robot."));
    visit(self.goals, um("goals", "Goal of each robot, in place of one for all."));
    visit(self.contact, plain("contact", "Behaviour of a robot that meets a wall."));
    visit(self.max_speed, um_per_s("max_speed", 1e-3, 1e5, "Maximum speed of an average robot."));
    visit(self.speed_spread,
          plain("speed_spread", 0, 1, "Relative standard deviation of the robots' speeds."));
    visit(self.heading_noise,
          deg("heading_noise", 0, 360, "Standard deviation of a robot's heading, per command."));
    visit(self.position_noise, um("position_noise", 0, 1e4,
                                  "Random drift of each robot, standard deviation after 1 s."));
    visit(self.sticking_interval,
          s("sticking_interval", 0, 1e6, "Mean time between two times a robot sticks; 0: never."));
    visit(self.sticking_time, s("sticking_time", 0, 1e6, "Mean time a robot sticks."));
    visit(self.response_lag, s("response_lag", 0, 10, "Dead time from a command to its effect."));
  }
};

}  // namespace microswarm
