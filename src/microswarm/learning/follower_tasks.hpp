// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::learning {

/// Ranges of random path-following tasks and their disturbances. Each task draws its own values.
/// Path lengths are in seconds at the task's speed.
struct FollowerTaskParams {
  double min_speed = 30;
  double max_speed = 90;
  double min_turn_rate = radians(90);
  double max_turn_rate = radians(360);
  double unlimited_share = 0.2;
  double max_flow = 0.2;
  double speed_error = 0.15;
  double position_noise = 3;
  double heading_noise = radians(3);
  double random_drift = 3;
  double missed_share = 0.02;
  double start_spread = 0.15;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(
        self.min_speed,
        um_per_s("min_speed", 1, 1e4, "Minimum commanded speed.").formerly("least_speed_um_per_s"));
    visit(
        self.max_speed,
        um_per_s("max_speed", 1, 1e4, "Maximum commanded speed.").formerly("most_speed_um_per_s"));
    visit(self.min_turn_rate,
          deg_per_s("min_turn_rate", 1, 3600, "Minimum turning limit of the swarm.")
              .formerly("least_turn_rate_deg_per_s"));
    visit(self.max_turn_rate,
          deg_per_s("max_turn_rate", 1, 3600, "Maximum turning limit of the swarm.")
              .formerly("most_turn_rate_deg_per_s"));
    visit(self.unlimited_share,
          plain("unlimited_share", 0, 1, "Share of tasks whose swarm turns at 36000 °/s."));
    visit(
        self.max_flow,
        plain("max_flow", 0, 0.8, "Maximum flow, as a share of the speed.").formerly("most_flow"));
    visit(self.speed_error, plain("speed_error", 0, 0.9, "Relative error of the speed."));
    visit(self.position_noise,
          um("position_noise", 0, 1e3, "Maximum noise of the observed position (sd)."));
    visit(self.heading_noise,
          deg("heading_noise", 0, 90, "Maximum noise of the observed heading (sd)."));
    visit(self.random_drift, um("random_drift", 0, 1e3, "Maximum random drift (sd after 1 s)."));
    visit(self.missed_share, plain("missed_share", 0, 1, "Share of frames without a swarm."));
    visit(self.start_spread,
          plain("start_spread", 0, 10, "Distance of the start from the path (sd), in seconds."));
  }
};

/// A path to follow from its first to its last point, as a scenario: a swarm in an open world.
struct FollowerTask {
  std::uint32_t number = 0;  ///< also selects the noise of its plant
  std::vector<Vec2> path{};
  experiment::Scenario scenario{};  ///< with pure pursuit as navigator
  World world{};
};

/// The task with this number, drawn from the stream (seed, learning, number).
FollowerTask follower_task(const FollowerTaskParams& params, std::uint64_t seed,
                           std::uint32_t number);

/// The task's scenario with this follower and lookahead.
experiment::Scenario with_follower(const FollowerTask& task,
                                   const navigation::FollowerParams& follower,
                                   double lookahead_time);

}  // namespace microswarm::learning
