// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/ribbon.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

Rng test_rng() { return Rng(7, Purpose::test); }

TEST(Ribbon, HoldsBeforeTheFirstCommandTakesEffect) {
  Rng rng = test_rng();
  Ribbon ribbon({.response_lag = 0.25}, {{5, 6}, 1});
  ribbon.step({0, 50}, 0.1, rng);
  ribbon.step({0, 50}, 0.1, rng);
  EXPECT_EQ(ribbon.pose(), (Pose2{{5, 6}, 1}));
  EXPECT_EQ(ribbon.speed(), 0);
  ribbon.step({0, 50}, 0.1, rng);
  EXPECT_EQ(ribbon.speed(), 50);
}

TEST(Ribbon, DeadTimeIsExactBetweenTicks) {
  for (double lag : {0.0, 0.03, 0.1, 0.137, 0.4}) {
    Rng rng = test_rng();
    Ribbon ribbon({.response_lag = lag}, {});
    for (int i = 0; i < 10; ++i) ribbon.step({0, 40}, 0.1, rng);
    EXPECT_NEAR(ribbon.pose().position.x, 40 * (1 - lag), 1e-6) << lag;
  }
}

TEST(Ribbon, CommandsTakeEffectInTheirOrder) {
  Rng rng = test_rng();
  Ribbon ribbon({.response_lag = 0.25}, {});
  for (double speed : {10.0, 20.0, 0.0, 0.0, 0.0, 0.0}) ribbon.step({0, speed}, 0.1, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 0.1 * 10 + 0.1 * 20, 1e-6);
  EXPECT_EQ(ribbon.speed(), 0);
}

TEST(Ribbon, TurnsAtMostAtItsRateAndNeverBeyondTheHeading) {
  Rng rng = test_rng();
  const RibbonParams params{.max_turn_rate = 2, .response_lag = 0};
  Ribbon ribbon(params, {{0, 0}, 3});
  double before = ribbon.pose().heading;
  for (int i = 0; i < 20; ++i) {
    ribbon.step({-2.5, 30}, 0.1, rng);
    EXPECT_LE(turn_between(before, ribbon.pose().heading), 2 * 0.1 + 1e-9);
    before = ribbon.pose().heading;
  }
  // From 3 rad the short way to -2.5 rad leads over π.
  EXPECT_NEAR(ribbon.pose().heading, -2.5, 1e-12);
}

TEST(Ribbon, ConstantTurningDrawsTheArcOfSpeedOverRate) {
  Rng rng = test_rng();
  Ribbon ribbon({.max_turn_rate = 1, .response_lag = 0}, {});
  for (int i = 0; i < 15; ++i) ribbon.step({pi, 60}, 0.1, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 60 * std::sin(1.5), 0.01);
  EXPECT_NEAR(ribbon.pose().position.y, 60 * (1 - std::cos(1.5)), 0.01);
}

TEST(Ribbon, SpeedIsLimitedAndNeverNegative) {
  Rng rng = test_rng();
  Ribbon ribbon({.max_speed = 80, .response_lag = 0}, {});
  ribbon.step({0, 1000}, 0.1, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 8, 1e-9);
  ribbon.step({0, -5}, 0.1, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 8, 1e-9);
}

TEST(Ribbon, SweptRunsFromTheOldPoseToTheNewOneInSmallPieces) {
  Rng rng = test_rng();
  Ribbon ribbon({.response_lag = 0.137, .position_noise = 3, .heading_noise = 0.2}, {});
  EXPECT_TRUE(ribbon.trajectory().empty());
  for (int i = 0; i < 20; ++i) {
    const Pose2 before = ribbon.pose();
    ribbon.step({0.3 * i, 40}, 0.1, rng);
    const auto trajectory = ribbon.trajectory();
    ASSERT_GE(trajectory.size(), 2u);
    EXPECT_EQ(trajectory.front().t, 0);
    EXPECT_EQ(trajectory.front().pose, before);
    EXPECT_EQ(trajectory.back().t, 0.1);
    EXPECT_EQ(trajectory.back().pose, ribbon.pose());
    for (std::size_t k = 1; k < trajectory.size(); ++k) {
      EXPECT_GT(trajectory[k].t, trajectory[k - 1].t);
      EXPECT_LE(trajectory[k].t - trajectory[k - 1].t, ribbon_substep + 1e-9);
    }
  }
}

TEST(Ribbon, NoiseIsThatOfOneSecondWhateverTheTick) {
  for (double tick : {0.05, 0.1, 0.5}) {
    Rng rng = test_rng();
    double sum = 0;
    constexpr int runs = 400;
    for (int run = 0; run < runs; ++run) {
      Ribbon ribbon({.response_lag = 0, .position_noise = 5}, {});
      for (int i = 0; i < static_cast<int>(std::lround(1 / tick)); ++i) ribbon.step({}, tick, rng);
      sum += squared_norm(ribbon.pose().position);
    }
    EXPECT_NEAR(std::sqrt(sum / (2 * runs)), 5, 0.5) << tick;
  }
}

TEST(Ribbon, SameStreamSameBits) {
  const RibbonParams params{.position_noise = 5, .heading_noise = 0.3};
  Rng a = test_rng(), b = test_rng();
  Ribbon one(params, {}), two(params, {});
  for (int i = 0; i < 50; ++i) {
    one.step({0.1 * i, 40}, 0.1, a);
    two.step({0.1 * i, 40}, 0.1, b);
  }
  EXPECT_EQ(one.pose(), two.pose());
}

TEST(Ribbon, AFlowCarriesItAlsoWhileItHolds) {
  Rng rng(1, Purpose::plant);
  Ribbon ribbon({.response_lag = 0, .drift = {4, -2}}, {{10, 10}, 0});
  ribbon.step({0, 0}, 0.5, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 12, 1e-9);
  EXPECT_NEAR(ribbon.pose().position.y, 9, 1e-9);
  EXPECT_EQ(ribbon.pose().heading, 0);
}

TEST(Ribbon, ItsSpeedMayBeOff) {
  Rng rng(1, Purpose::plant);
  Ribbon ribbon({.max_speed = 80, .response_lag = 0, .speed_factor = 0.9}, {});
  ribbon.step({0, 100}, 0.5, rng);
  EXPECT_NEAR(ribbon.pose().position.x, 36, 1e-9);
  EXPECT_NEAR(ribbon.speed(), 72, 1e-9);
}

}  // namespace
}  // namespace microswarm
