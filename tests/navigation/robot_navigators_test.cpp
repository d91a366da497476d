// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "microswarm/navigation/gathering/aggregation_check.hpp"
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"
#include "microswarm/navigation/global_input/plan_executor.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/navigation/robot_scene.hpp"

namespace microswarm::navigation {
namespace {

constexpr double robot_tick = 0.1;

RobotSwarmParams two_robots() {
  RobotSwarmParams p;
  p.starts = {{60, 300}, {60, 250}};
  p.goals = {{330, 300}, {330, 200}};
  p.contact = ContactRule::slide;
  p.max_speed = 30;  // an input of 5 µm takes two ticks
  return p;
}

Task robot_task(const RobotSwarmParams& robots, std::optional<Vec2> goal = {}) {
  return {.robots = robots, .goal = goal, .goal_tolerance = 20, .tick = robot_tick};
}

TEST(RobotDelayCompensator, IsWhatComesUnderDelayAndLag) {
  RobotSwarmParams params = two_robots();
  params.response_lag = robot_tick;
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 3);
  RobotDelayCompensator forecast(rig.map, params.max_speed * robot_tick, params.contact,
                                 params.response_lag);
  for (int i = 0; i < 200; ++i) {
    const Robots foretold = forecast.at_effect(rig.observe());
    const Command command{0.3 * i, 25};
    forecast.note(rig.now, command);
    rig.apply(command);
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_LE(distance(foretold.position(k), rig.swarm.robots().position(k)), 1e-3) << i;
  }
}

// Workspace L: the top of a block is at y = 175 µm, its left side at x = 175 µm.
TEST(RobotDelayCompensator, ARobotSeenJustInAWallDoesNotGoThroughIt) {
  const RobotSwarmParams params = two_robots();
  const test::RobotScene rig(scenes::global_world(1), params, params.starts, 0);
  RobotDelayCompensator forecast(rig.map, params.max_speed * robot_tick, params.contact, 0);
  Observation seen = rig.observe();
  const std::vector<Vec2> positions{{260, 174.99}, {330, 200}};
  seen.robots = positions;
  forecast.note(0, {radians(-90), 30});
  seen.now = 0.1;
  const Robots robots = forecast.at_effect(seen);
  EXPECT_NEAR(robots.position(0).y, 175, 0.05);
  EXPECT_NEAR(robots.position(0).x, 260, 0.05);
  EXPECT_NEAR(robots.position(1).y, 197, 1e-3);
}

TEST(PlanExecutor, SeenWithErrorsItArrives) {
  const RobotSwarmParams params = two_robots();
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 1);
  PlanExecutor player({}, robot_task(params), Rng(1, Purpose::planner));
  player.prepare(rig.world, {});
  Rng eye(3, Purpose::test);
  int planned = 0;
  for (int i = 0; i < 3000 && rig.worst() > 20; ++i) {
    Observation seen = rig.observe();
    std::vector<Vec2> positions(seen.robots.begin(), seen.robots.end());
    for (Vec2& position : positions) position += 0.2 * Vec2{eye.normal(), eye.normal()};
    seen.robots = positions;
    rig.apply(player.step(seen, {}));
    planned += player.view().planned;
  }
  EXPECT_LE(rig.worst(), 20);
  EXPECT_LE(planned, 3);  // an error at a corner may look like a robot on its other side
}

TEST(PlanExecutor, WithoutErrorsItPlansOnceAndArrives) {
  for (const std::size_t delay : {0, 2}) {
    const RobotSwarmParams params = two_robots();
    test::RobotScene rig(scenes::global_world(1), params, params.starts, delay);
    PlanExecutor player({}, robot_task(params), Rng(1, Purpose::planner));
    player.prepare(rig.world, {});
    int planned = 0;
    for (int i = 0; i < 3000 && rig.worst() > 20; ++i) {
      rig.apply(player.step(rig.observe(), {}));
      planned += player.view().planned;
    }
    EXPECT_LE(rig.worst(), 20) << delay;
    EXPECT_EQ(planned, 1) << delay;
  }
}

TEST(PlanExecutor, WithErrorsItFindsItsWayAgain) {
  RobotSwarmParams params = two_robots();
  params.position_noise = 3;
  params.heading_noise = 0.05;
  params.speed_spread = 0.1;
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 1);
  PlanExecutor player({}, robot_task(params), Rng(1, Purpose::planner));
  player.prepare(rig.world, {});
  int found_again = 0;
  for (int i = 0; i < 6000 && rig.worst() > 20; ++i) {
    rig.apply(player.step(rig.observe(), {}));
    found_again += player.view().state == NavigatorState::replan ||
                   player.view().state == NavigatorState::rejoin;
  }
  EXPECT_LE(rig.worst(), 20);
  EXPECT_GT(found_again, 1);
}

TEST(PlanExecutor, RobotsThatWereCarriedAwayJoinThePlanAgain) {
  const RobotSwarmParams params = two_robots();
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 0);
  PlanExecutor player({}, robot_task(params), Rng(1, Purpose::planner));
  player.prepare(rig.world, {});
  std::vector<Observation> seen;
  for (int i = 0; i < 20; ++i) rig.apply(player.step(rig.observe(), {}));
  // Back to the start: the first place of the plan is joined, nothing is planned.
  rig.history = {params.starts};
  player.step(rig.observe(), {});
  EXPECT_EQ(player.view().state, NavigatorState::rejoin);
  EXPECT_FALSE(player.view().planned);
}

TEST(PlanExecutor, WithoutAPlanItHoldsAndTriesAgainLater) {
  const RobotSwarmParams params = two_robots();
  PlanExecutorParams hard;
  hard.planner.max_nodes = 1;
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 0);
  PlanExecutor player(hard, robot_task(params), Rng(1, Purpose::planner));
  player.prepare(rig.world, {});
  int planned = 0;
  int stuck = 0;
  for (int i = 0; i < 250; ++i) {
    rig.apply(player.step(rig.observe(), {}));
    planned += player.view().planned;
    stuck += player.view().state == NavigatorState::stuck;
  }
  EXPECT_GE(planned, 2);
  EXPECT_LE(planned, 3);
  EXPECT_GT(stuck, 100);
}

TEST(PlanExecutor, HoldsWhenItSeesTooFewTooOldOrIsThere) {
  const RobotSwarmParams params = two_robots();
  test::RobotScene rig(scenes::global_world(1), params, params.starts, 0);
  PlanExecutor player({}, robot_task(params), Rng(1, Purpose::planner));
  player.prepare(rig.world, {});
  Observation seen = rig.observe();
  seen.robots = seen.robots.first(1);
  EXPECT_EQ(player.step(seen, {}).speed, 0);
  EXPECT_EQ(player.view().state, NavigatorState::blind);
  seen = rig.observe();
  seen.now = 10;
  EXPECT_EQ(player.step(seen, {}).speed, 0);
  const std::vector<Vec2> there{{325, 310}, {330, 200}};
  seen = rig.observe();
  seen.robots = there;
  EXPECT_EQ(player.step(seen, {}).speed, 0);
  EXPECT_EQ(player.view().state, NavigatorState::arrived);
}

TEST(AggregationNavigator, GathersUnderLagAndDelayAndHoldsThen) {
  const scenes::Vascular t = scenes::t_junction();
  RobotSwarmParams params;
  params.max_speed = 10;  // a step of 1 µm a tick
  std::vector<Vec2> starts;
  Rng rng(4, Purpose::scene);
  for (int i = 0; i < 64; ++i) starts.push_back({rng.uniform(2, 98), rng.uniform(92, 98)});
  test::RobotScene rig(t.map(), params, starts, 1);
  AggregationNavigator navigator({}, robot_task(params, t.goal), Rng(1, Purpose::planner));
  navigator.prepare(rig.world, {});
  int steps = 0;
  while (steps < 2000) {
    const Command command = navigator.step(rig.observe(), {});
    if (navigator.view().state == NavigatorState::arrived) break;
    EXPECT_NEAR(command.speed, 10, 1e-9);
    rig.apply(command);
    ++steps;
  }
  EXPECT_LT(steps, 1000);
  EXPECT_LT(navigator.policy()->mean_distance(), 10);
  Observation nothing = rig.observe();
  nothing.robots = {};
  EXPECT_EQ(navigator.step(nothing, {}).speed, 0);
  EXPECT_EQ(navigator.view().state, NavigatorState::blind);
}

TEST(MapAssumptions, KnowsDeadEndsAndWhatIsApart) {
  const scenes::Vascular t = scenes::t_junction();
  const Map map = t.map();
  EXPECT_EQ(map_assumptions(map, t.goal, 10).exits, 1);
  EXPECT_GT(map_assumptions(map, t.goal, 10).reached_share, 0.999);
  EXPECT_TRUE(unmet_assumptions(map, t.goal, 10).empty());
  EXPECT_EQ(map_assumptions(map, {50, 95}, 10).exits, 3);  // in the junction
  EXPECT_EQ(map_assumptions(map, {20, 95}, 10).exits, 2);
  // Two rooms, and a goal in the smaller one.
  const Map apart({{0, 0}, {100, 10}}, {scenes::rectangle({{24, -1}, {25, 11}})});
  EXPECT_NEAR(map_assumptions(apart, {3, 5}, 10).reached_share, 24.0 / 99, 0.02);
  EXPECT_EQ(unmet_assumptions(apart, {3, 5}, 10).size(), 1u);
}

TEST(MapAssumptions, TellsWhenThereIsLittleToDivide) {
  EXPECT_NE(too_few_regions(4), "");
  EXPECT_EQ(too_few_regions(5), "");
}

}  // namespace
}  // namespace microswarm::navigation
