// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/unicycle.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/swarm/body/ribbon.hpp"

namespace microswarm {
namespace {

using std::numbers::pi;

struct Motion {
  Pose2 from;
  Command command;
  double turn_rate, dt;
};

Motion random_motion(Rng& rng) {
  Motion m;
  m.from = {{rng.uniform(-500, 500), rng.uniform(-500, 500)}, rng.uniform(-pi, pi)};
  m.command = {rng.uniform(-pi, pi), rng.uniform(0, 200)};
  m.turn_rate = std::pow(10.0, rng.uniform(-1, 2.5));
  m.dt = rng.uniform(0.01, 0.5);
  return m;
}

Pose2 predict(const Motion& m, double dt) {
  return predict_unicycle(m.from, m.command, m.turn_rate, dt);
}

// The midpoint rule with n steps leaves an error of order 1/n² in a turn, 1/n where it ends.
TEST(Unicycle, APredictionIsTheLimitOfManySteps) {
  Rng rng(3, Purpose::test);
  for (int trial = 0; trial < 200; ++trial) {
    const Motion m = random_motion(rng);
    constexpr int steps = 20'000;
    Pose2 pose = m.from;
    for (int k = 0; k < steps; ++k)
      pose = unicycle_step(pose, m.command, m.turn_rate, m.dt / steps);
    const Pose2 predicted = predict(m, m.dt);
    EXPECT_LT(distance(predicted.position, pose.position), 1e-2 * m.dt) << trial;
    EXPECT_LT(turn_between(predicted.heading, pose.heading), 1e-9) << trial;
  }
}

TEST(Unicycle, APredictionInTwoPartsIsThatOfTheWhole) {
  Rng rng(4, Purpose::test);
  for (int trial = 0; trial < 2000; ++trial) {
    Motion m = random_motion(rng);
    const Pose2 whole = predict(m, m.dt);
    const double first = rng.uniform(0, m.dt);
    const double rest = m.dt - first;
    m.from = predict(m, first);
    const Pose2 parts = predict(m, rest);
    EXPECT_LT(distance(whole.position, parts.position), 1e-9) << trial;
    EXPECT_LT(turn_between(whole.heading, parts.heading), 1e-9) << trial;
  }
}

// A swarm that turns by 3600° a second and moves 8 µm a tick: a midpoint is up to 5 µm off.
TEST(Unicycle, AFastTurnerIsPredictedWhereItGoes) {
  Rng rng(5, Purpose::test);
  for (int trial = 0; trial < 100; ++trial) {
    RibbonParams fast{.radius = 7, .max_speed = 80};
    fast.max_turn_rate = 20 * pi;
    fast.response_lag = 0;
    const Pose2 start{{0, 0}, rng.uniform(-pi, pi)};
    Ribbon ribbon(fast, start);
    const Command command{rng.uniform(-pi, pi), 80};
    ribbon.step(command, 0.1, rng);
    const Pose2 predicted = predict_unicycle(start, command, fast.max_turn_rate, 0.1);
    EXPECT_LT(distance(predicted.position, ribbon.pose().position), 0.25) << trial;
  }
}

TEST(Unicycle, HoldAndSwarmsThatTurnAtOnceAreAsInAStep) {
  const Pose2 pose{{3, 4}, 1};
  EXPECT_EQ(predict_unicycle(pose, {2, 0}, 3, 0.1), pose);
  constexpr double at_once = std::numeric_limits<double>::infinity();
  EXPECT_EQ(predict_unicycle(pose, {2, 50}, at_once, 0.1),
            unicycle_step(pose, {2, 50}, at_once, 0.1));
  const Pose2 straight = predict_unicycle(pose, {1, 50}, 0, 0.1);
  EXPECT_EQ(straight.heading, 1);
  EXPECT_NEAR(distance(straight.position, pose.position), 5, 1e-12);
}

}  // namespace
}  // namespace microswarm
