// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/vortex.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"

namespace microswarm {
namespace {

TEST(Vortex, IsAsFastAsItIsPitched) {
  const VortexParams params{.max_speed = 80, .max_pitch = 0.1, .response_lag = 0};
  EXPECT_DOUBLE_EQ(helix_pitch(params, {0, 40}), 0.05);
  EXPECT_DOUBLE_EQ(helix_pitch(params, {0, 400}), 0.1);
  Rng rng(1, Purpose::plant);
  Vortex vortex(params, {{5, 6}, 1});
  vortex.step({2, 400}, 0.5, rng);
  EXPECT_NEAR(vortex.pose().position.x, 5 + 40 * std::cos(2.0), 1e-9);
  EXPECT_NEAR(vortex.pose().position.y, 6 + 40 * std::sin(2.0), 1e-9);
  EXPECT_DOUBLE_EQ(vortex.pose().heading, 2);
}

TEST(Vortex, TurnsAtOnceWhenItsLagIsOver) {
  Vortex vortex({.max_speed = 100, .response_lag = 0.1}, {});
  Rng rng(1, Purpose::plant);
  vortex.step({0, 100}, 0.1, rng);
  EXPECT_EQ(vortex.pose().position, Vec2{});
  vortex.step({pi / 2, 100}, 0.1, rng);
  EXPECT_NEAR(vortex.pose().position.x, 10, 1e-9);
  vortex.step({0, 0}, 0.1, rng);
  EXPECT_NEAR(vortex.pose().position.x, 10, 1e-9);
  EXPECT_NEAR(vortex.pose().position.y, 10, 1e-9);
}

TEST(Vortex, WidensWhileItMoves) {
  Vortex vortex({.radius = 300, .moving_radius = 400, .radius_lag = 1, .response_lag = 0}, {});
  Rng rng(1, Purpose::plant);
  vortex.step({0, 100}, 1, rng);
  EXPECT_NEAR(vortex.radius(), 400 - 100 * std::exp(-1.0), 1e-9);
  EXPECT_EQ(vortex.trajectory().front().radius, 300);
  EXPECT_EQ(vortex.trajectory().back().radius, vortex.radius());
  vortex.step({0, 0}, 20, rng);
  EXPECT_NEAR(vortex.radius(), 300, 1e-5);
}

TEST(Vortex, ItsRippleHasASpreadAndALimit) {
  const VortexParams params{
      .radius = 300, .moving_radius = 300, .radius_lag = 0.5, .radius_ripple = 20};
  Vortex vortex(params, {});
  Rng rng(1, Purpose::plant);
  double squares = 0;
  constexpr int steps = 5000;
  for (int i = 0; i < steps; ++i) {
    vortex.step({0, 0}, 0.5, rng);
    for (const PoseStamped& p : vortex.trajectory()) {
      ASSERT_LE(p.radius, swarm_limits(params).radius);
      ASSERT_GE(p.radius, 260);
    }
    squares += (vortex.radius() - 300) * (vortex.radius() - 300);
  }
  EXPECT_NEAR(std::sqrt(squares / steps), 20, 3);
}

TEST(SwarmBody, IsWhatItsParametersSay) {
  Rng a(1, Purpose::plant), b(1, Purpose::plant);
  const RibbonParams params{.position_noise = 2};
  SwarmBody body(params, {{1, 2}, 0.5});
  Ribbon ribbon(params, {{1, 2}, 0.5});
  for (int i = 0; i < 20; ++i) {
    body.step({1, 50}, 0.1, a);
    ribbon.step({1, 50}, 0.1, b);
  }
  EXPECT_EQ(body.pose().pose.position, ribbon.pose().position);
  EXPECT_EQ(body.pose().radius, params.radius);
  EXPECT_EQ(body.speed(), ribbon.speed());
  EXPECT_TRUE(std::isinf(swarm_limits(VortexParams{}).max_turn_rate));
}

}  // namespace
}  // namespace microswarm
