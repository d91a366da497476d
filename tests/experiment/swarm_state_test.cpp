// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/swarm_state.hpp"

#include <gtest/gtest.h>

#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

/// A plant that knows only what is seen.
class Seen : public Plant {
 public:
  Observation observe() override { return {}; }
  void apply(const Command&, double) override {}
};

TEST(SwarmState, SpeedIsThatBetweenTwoSights) {
  const Scenario scenario = open_room();
  const Seen plant;
  SwarmState state(scenario, plant);
  GoalMonitor goal(scenario);
  const auto speed_at = [&](double t, std::optional<double> x) {
    Observation seen{.now = t};
    if (x) seen.swarm = SwarmPose{.pose = {{*x, 100}, 0}, .radius = 20};
    state.take(seen, goal);
    return state.now().speed;
  };
  speed_at(0.05, {});
  EXPECT_EQ(speed_at(0.1, 900), 0) << "it need not be at the scenario's start";
  EXPECT_NEAR(speed_at(0.2, 910), 100, 1e-6);
  speed_at(0.3, {});
  EXPECT_NEAR(speed_at(0.4, 930), 100, 1e-6);
}

}  // namespace
}  // namespace microswarm::experiment
