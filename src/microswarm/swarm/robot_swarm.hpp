// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/swarm/contracts.hpp"
#include "microswarm/swarm/lagging_commands.hpp"
#include "microswarm/swarm/robot_stepper.hpp"

namespace microswarm {

/// Robots that are told apart: points that all get the same input and do not block each other
/// [global, gather]. On a real rig they are not alike: each has a speed of its own, wavers, and
/// sticks to the floor now and then.
struct RobotSwarmParams {
  int count = 0;
  std::vector<Vec2> starts;
  std::vector<Vec2> goals;
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
    visit(self.count, {"count",
                       Unit::none,
                       {0, 1e6},
                       "Robots at random places from which the goal is reached; "
                       "0: those of `starts_um`."});
    visit(self.starts, {"starts", Unit::um, {}, "Where each robot starts."});
    visit(self.goals, {"goals", Unit::um, {}, "A goal for each robot, in place of one for all."});
    visit(self.contact, {"contact", Unit::none, {}, "What a robot does that meets a wall."});
    visit(self.max_speed,
          {"max_speed", Unit::um_per_s, {1e-3, 1e5}, "Fastest speed, of an ordinary robot."});
    visit(self.speed_spread, {"speed_spread",
                              Unit::none,
                              {0, 1},
                              "Spread of the robots' own speeds: standard deviation / mean."});
    visit(self.heading_noise, {"heading_noise",
                               Unit::deg,
                               {0, 360},
                               "Standard deviation of each robot's direction, drawn anew for "
                               "every command."});
    visit(self.position_noise, {"position_noise",
                                Unit::um,
                                {0, 1e4},
                                "Random drift of each robot, standard deviation after 1 s."});
    visit(self.sticking_interval,
          {"sticking_interval", Unit::s, {0, 1e6}, "Mean time until a robot sticks; 0: never."});
    visit(self.sticking_time,
          {"sticking_time", Unit::s, {0, 1e6}, "Mean time for which it sticks."});
    visit(self.response_lag,
          {"response_lag", Unit::s, {0, 10}, "Dead time from a command to its effect."});
  }
};

/// Robots as one body: their middle, and how far they are from it (root mean square). There is one
/// at least.
SwarmPose body_of(std::span<const Vec2> robots, double heading);

/// The moving part of that model.
class RobotSwarm {
 public:
  /// Keeps the stepper, which the swarm's map was made for. The robots' own speeds are drawn from
  /// `rng`: normal about 1, from 0.1 to 3.
  RobotSwarm(const RobotSwarmParams& params, RobotStepper stepper, std::span<const Vec2> starts,
             Rng& rng);

  const Robots& robots() const { return robots_; }
  /// Lets `dt` seconds pass under `command`, which takes effect `response_lag` later; noise is
  /// drawn from `rng`. Robots that are all alike move as `RobotStepper::step` moves them.
  void step(const Command& command, double dt, Rng& rng);

 private:
  void advance_each(const Command& command, double dt, Rng& rng);
  bool stuck(std::size_t robot, double dt, Rng& rng);

  RobotSwarmParams params_;
  RobotStepper stepper_;
  Robots robots_;
  std::vector<double> own_speed_;  // share of the commanded one
  std::vector<double> stuck_for_;  // [s]
  LaggingCommands commands_;
};

}  // namespace microswarm
