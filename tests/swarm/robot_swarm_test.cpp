// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/robot_swarm.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

/// A room of 400 × 300 µm with a bar in it.
Map room() {
  return {Box{{0, 0}, {400, 300}}, {Polygon{{{180, 0}, {220, 0}, {220, 200}, {180, 200}}, {}}}};
}

std::vector<Vec2> places(int count) {
  Rng rng(7, Purpose::test);
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) out.push_back({rng.uniform(5, 170), rng.uniform(5, 290)});
  return out;
}

Vec2 middle(const Robots& robots) {
  Vec2 sum{};
  for (std::size_t i = 0; i < robots.size(); ++i) sum += robots.position(i);
  return sum / static_cast<double>(robots.size());
}

TEST(Displacement, IsExactAlongTheAxesAndUndoneByCommandFor) {
  EXPECT_EQ(displacement({radians(90), 30}, 0.1).x, 0);
  EXPECT_EQ(displacement({radians(180), 30}, 0.1).y, 0);
  EXPECT_EQ(displacement({radians(-90), 30}, 0.1).x, 0);
  const Vec2 move{3, -4};
  EXPECT_NEAR(distance(displacement(command_for(move, 0.2), 0.2), move), 0, 1e-12);
}

TEST(LaggingCommands, EachTakesEffectWhenItsLagIsOver) {
  LaggingCommands commands(0.15);
  std::vector<std::pair<double, double>> acted;  // speed, seconds
  const auto act = [&](const Command& c, double dt) { acted.emplace_back(c.speed, dt); };
  commands.pass({0, 1}, 0.1, 0.1, act);
  commands.pass({0, 2}, 0.1, 0.1, act);
  commands.pass({0, 3}, 0.1, 0.1, act);
  const std::vector<std::pair<double, double>> expected{
      {0, 0.1}, {0, 0.05}, {1, 0.05}, {1, 0.05}, {2, 0.05}};
  ASSERT_EQ(acted.size(), expected.size());
  for (std::size_t i = 0; i < acted.size(); ++i) {
    EXPECT_EQ(acted[i].first, expected[i].first) << i;
    EXPECT_NEAR(acted[i].second, expected[i].second, 1e-12) << i;
  }
}

TEST(RobotSwarm, AlikeRobotsMoveAsTheStepperMovesThem) {
  const Map map = room();
  const RobotStepper stepper(map, 8);
  RobotSwarmParams params;
  params.response_lag = 0;
  Rng rng(1, Purpose::plant);
  RobotSwarm swarm(params, stepper, places(40), rng);
  Robots expected = stepper.place(places(40));
  for (int i = 0; i < 200; ++i) {
    const Command command{0.37 * i, i % 3 == 0 ? 500.0 : 50.0};  // the first is too fast
    swarm.step(command, 0.1, rng);
    stepper.step(expected, displacement({command.heading, std::min(command.speed, 80.0)}, 0.1),
                 ContactRule::stop);
    ASSERT_EQ(swarm.robots().x, expected.x);
    ASSERT_EQ(swarm.robots().y, expected.y);
  }
}

TEST(RobotSwarm, RealRobotsStayInFreeSpace) {
  const Map map = room();
  RobotSwarmParams params;
  params.speed_spread = 0.4;
  params.heading_noise = 0.3;
  params.position_noise = 20;
  params.sticking_interval = 5;
  params.sticking_time = 2;
  Rng rng(2, Purpose::plant);
  RobotSwarm swarm(params, RobotStepper(map, 8), places(60), rng);
  for (int i = 0; i < 500; ++i) {
    swarm.step({0.1 * i, 80}, 0.1, rng);
    for (std::size_t k = 0; k < 60; ++k)
      ASSERT_TRUE(map.is_free(swarm.robots().position(k), 0)) << i << " " << k;
  }
}

TEST(RobotSwarm, StickingTakesItsShareOfTheWay) {
  const Map map(Box{{0, 0}, {100'000, 300}}, {});
  RobotSwarmParams params;
  params.response_lag = 0;
  params.sticking_interval = 4;
  params.sticking_time = 2;
  Rng rng(3, Purpose::plant);
  RobotSwarm swarm(params, RobotStepper(map, 8), places(400), rng);
  const Vec2 before = middle(swarm.robots());
  for (int i = 0; i < 600; ++i) swarm.step({0, 80}, 0.1, rng);
  const double share = (middle(swarm.robots()).x - before.x) / (60 * 80);
  EXPECT_NEAR(share, 4.0 / 6, 0.03);
}

}  // namespace
}  // namespace microswarm
