// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "microswarm/experiment/monitors/goal_monitor.hpp"
#include "microswarm/experiment/monitors/hold_monitor.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

using Way = std::vector<PoseStamped>;

TEST(GoalMonitor, ArrivalIsTheFirstMomentWithinTheTolerance) {
  const Way way{{0, {{0, 0}, 0}}, {0.1, {{10, 0}, 0}}, {0.2, {{20, 0}, 0}}};
  EXPECT_NEAR(first_arrival(way, {30, 0}, 15).value(), 0.15, 1e-12);
  EXPECT_EQ(first_arrival(way, {3, 0}, 5).value(), 0);
  EXPECT_FALSE(first_arrival(way, {30, 0}, 5).has_value());
}

TEST(GoalMonitor, TakesTheGoalAndToleranceOfTheScenarioWhenTheyChange) {
  Scenario scenario = open_room();
  scenario.goal = Vec2{1800, 500};
  scenario.goal_tolerance = 50;
  GoalMonitor goal(scenario);
  goal.take_goal({200, 500});
  EXPECT_EQ(goal.start_distance(), 1600);
  EXPECT_EQ(goal.left({1760, 500}, {}), 40);
  EXPECT_TRUE(goal.reached(40));
  scenario.goal_tolerance = 30;
  EXPECT_FALSE(goal.reached(40));
  // The same goal keeps the distance at which it was taken; a new one is measured from here.
  goal.take_goal({1700, 500});
  EXPECT_EQ(goal.start_distance(), 1600);
  scenario.goal = Vec2{1700, 900};
  goal.take_goal({1700, 500});
  EXPECT_EQ(goal.start_distance(), 400);
  EXPECT_FALSE(goal.take_robots(world_of(scenario).at(0).map()));
  EXPECT_FALSE(goal.has_robots());
}

TEST(HoldMonitor, CountsUninterruptedHoldingUpToTheLimit) {
  Scenario scenario = open_room();
  scenario.tick = 0.1;
  scenario.hold_limit = 0.3;
  HoldMonitor hold(scenario);
  EXPECT_EQ(hold.take({0, 60}), std::nullopt);
  EXPECT_EQ(hold.take({0, 0}), EventKind::hold_begins);
  EXPECT_EQ(hold.take({0, 0}), std::nullopt);
  EXPECT_FALSE(hold.at_limit());
  EXPECT_EQ(hold.take({0, 60}), EventKind::hold_ends);
  EXPECT_FALSE(hold.holds());
  for (int tick = 0; tick < 3; ++tick) hold.take({0, 0});
  EXPECT_TRUE(hold.at_limit());
}

TEST(HoldMonitor, AHoldLimitOfZeroIsNotReachedByASwarmThatMoves) {
  Scenario scenario = open_room();
  scenario.hold_limit = 0;
  HoldMonitor hold(scenario);
  hold.take({0, 60});
  EXPECT_FALSE(hold.at_limit());
}

}  // namespace
}  // namespace microswarm::experiment
