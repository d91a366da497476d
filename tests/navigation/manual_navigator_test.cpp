// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/manual/manual_navigator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace microswarm::navigation {
namespace {

Observation at(double now, double heading = 0.5) {
  return {.now = now, .seen = now, .swarm = SwarmPose{{{100, 100}, heading}, 20}};
}

TEST(ManualNavigator, ACommandLastsForItsTimeFromTheStepThatTakesIt) {
  ManualNavigator navigator(60, 0.5);
  EXPECT_EQ(navigator.step(at(0), {}).speed, 0);
  navigator.steer({1, 40});
  for (const double now : {7.0, 7.1, 7.4}) {
    EXPECT_EQ(navigator.step(at(now), {}).heading, 1);
    EXPECT_EQ(navigator.step(at(now), {}).speed, 40);
    EXPECT_EQ(navigator.view().state, NavigatorState::manual);
  }
  EXPECT_EQ(navigator.step(at(7.5), {}).speed, 0);
  EXPECT_EQ(navigator.step(at(7.5), {}).heading, 0.5);  // the swarm's
  navigator.steer({1, 40});
  EXPECT_EQ(navigator.step(at(8), {}).speed, 40);
  navigator.release();
  EXPECT_EQ(navigator.step(at(8.1), {}).speed, 0);
}

TEST(ManualNavigator, KeepsTheSwarmsSpeedLimitAndTakesNoNonsense) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ManualNavigator navigator(60);
  const auto speed_of = [&](const Command& command) {
    navigator.steer(command);
    const Command given = navigator.step(at(0), {});
    EXPECT_TRUE(std::isfinite(given.heading));
    return given.speed;
  };
  EXPECT_EQ(speed_of({0, 1e300}), 60);
  EXPECT_EQ(speed_of({0, -5}), 0);
  EXPECT_EQ(speed_of({0, nan}), 0);
  EXPECT_EQ(speed_of({nan, 50}), 0);
  EXPECT_EQ(speed_of({0, std::numeric_limits<double>::infinity()}), 0);
}

}  // namespace
}  // namespace microswarm::navigation
