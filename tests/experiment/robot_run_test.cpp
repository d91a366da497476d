// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/plant/robot_plant.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

/// Robots in a T: a bar with a stem that hangs from it.
Scenario t_junction() {
  Scenario s;
  s.name = "T";
  s.map = formats::PolygonsMap{
      .lo = {0, 50},
      .hi = {100, 100},
      .walls = {{{0, 50}, {45, 50}, {45, 90}, {0, 90}}, {{55, 50}, {100, 50}, {100, 90}, {55, 90}}},
      .discs = {}};
  s.robots.emplace().count = 32;
  s.robots->max_speed = 10;
  s.goal = Vec2{50, 53};
  s.goal_tolerance = 10;
  s.navigator = navigation::AggregationParams{};
  s.time_limit = 200;
  return s;
}

Scenario two_robots() {
  Scenario s;
  s.name = "L";
  s.map = formats::PolygonsMap{.lo = {50, 50},
                               .hi = {350, 350},
                               .walls = {{{175, 150}, {275, 150}, {275, 175}, {175, 175}},
                                         {{150, 150}, {175, 150}, {175, 250}, {150, 250}}},
                               .discs = {}};
  s.robots.emplace().starts = {{60, 300}, {60, 250}};
  s.robots->goals = {{330, 300}, {330, 200}};
  s.robots->contact = ContactRule::slide;
  s.goal_tolerance = 20;
  s.navigator = navigation::PlanExecutorParams{};
  return s;
}

TEST(RobotRun, GathersAndComesBackFromItsFileToTheSameBits) {
  Scenario scenario = t_junction();
  scenario.robots->speed_spread = 0.1;
  scenario.robots->position_noise = 1;
  ASSERT_EQ(check_error(scenario), "");
  const Record record = record_of(scenario);
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_LE(record.result.metrics.goal_distance, 10);
  EXPECT_EQ(record.robots.front().positions.size(), 32u);
  EXPECT_EQ(record.robots.back().t, record.result.metrics.time);
  const auto file = std::filesystem::path(testing::TempDir()) / "robots.h5";
  write_record(record, file);
  const Record again = read_record(file);
  EXPECT_EQ(again.hash(), record.hash());
  EXPECT_EQ(replay(again).difference, "");
  EXPECT_NE(record_of(scenario, 1).hash(), record.hash());
}

TEST(RobotRun, GoalsOfTheirOwn) {
  ASSERT_EQ(check_error(two_robots()), "");
  const Record record = record_of(two_robots());
  EXPECT_EQ(record.result.status, Status::solved);
  const std::vector<Vec2>& positions = record.robots.back().positions;
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LE(distance(positions[i], record.scene.scenario.robots->goals[i]), 20);
  EXPECT_EQ(replay(record).difference, "");
}

TEST(RobotRun, LongRunsKeepSomeMoments) {
  Scenario scenario = t_junction();
  scenario.goal_tolerance = 0.01;  // never
  std::get<navigation::AggregationParams>(scenario.navigator).sigma = 0;
  scenario.time_limit = 60;
  const Record record = record_of(scenario);
  EXPECT_EQ(record.result.status, Status::time_limit);
  EXPECT_EQ(record.frames.size(), 601u);
  EXPECT_LE(record.robots.size(), 129u);
  EXPECT_GE(record.robots.size(), 64u);
  EXPECT_EQ(record.robots.front().t, 0);
  EXPECT_EQ(record.robots.back().t, record.frames.back().t);
  for (std::size_t i = 2; i + 1 < record.robots.size(); ++i)
    EXPECT_NEAR(record.robots[i].t - record.robots[i - 1].t, record.robots[1].t, 1e-9);
}

TEST(RobotCheck, WhatCannotBeMeant) {
  Scenario s = t_junction();
  s.robots->count = 0;
  EXPECT_EQ(check_error(s), "s.yaml: no robots: give robots.count or robots.starts_um");
  s = t_junction();
  s.robots->starts = {{50, 95}};
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(s), "s.yaml", {"robots.count", "robots.starts_um"}));
  s = t_junction();
  s.goal.reset();
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"missing", "goal_um"}));
  s = t_junction();
  s.goal = Vec2{30, 80};
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"goal", "10 µm", "wall 1"}));
  s = t_junction();
  s.start = Pose2{};
  EXPECT_NE(check_error(s), "");
  s = t_junction();
  s.navigator = navigation::HierarchicalParams{};
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"needs", "swarm", "robots"}));
  s = t_junction();
  s.robots->contact = ContactRule::slide;
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"needs", "robots", "walls"}));
  s = two_robots();
  s.robots->goals.pop_back();
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml",
                                       {"robots.goals_um", "1", "robots.starts_um", "2"}));
  s = two_robots();
  s.robots->starts[1] = {200, 160};
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(s), "s.yaml", {"robot 2", "start", "10 µm", "wall 1"}));
  s = two_robots();
  s.robots->starts[1] = s.robots->starts[0];
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"1", "2", "start"}));
  s = two_robots();
  s.robots->starts.assign(65, {60, 300});
  s.robots->goals.assign(65, {330, 300});
  EXPECT_TRUE(test::is_one_line_naming(check_error(s), "s.yaml", {"65", "robots", "64"}));
  s = two_robots();
  std::get<formats::PolygonsMap>(s.map).walls = {{{200, 50}, {210, 50}, {210, 350}, {200, 350}}};
  EXPECT_EQ(check_error(s),
            "s.yaml: robot 1 is cut off from its goal by walls\n"
            "s.yaml: robot 2 is cut off from its goal by walls");
}

TEST(RobotPlant, ShowsTheRobotsAsTheyWere) {
  Scenario s = two_robots();
  s.sensing.observation_delay = 0.25;
  s.robots->response_lag = 0;
  RobotPlant plant(s, build_world(load_scene(s, {})));
  for (int i = 0; i < 10; ++i) plant.apply({0, 10}, 0.1);
  const Observation seen = plant.observe();
  EXPECT_NEAR(seen.seen, 0.75, 1e-12);
  EXPECT_NEAR(seen.robots[0].x, 60 + 7.5, 1e-3);
  EXPECT_NEAR(plant.ground_truth()->robots[0].x, 70, 1e-3);
  EXPECT_NEAR(seen.swarm->pose.position.y, 275, 1e-3);
  EXPECT_NEAR(seen.swarm->radius, 25, 1e-3);
}

}  // namespace
}  // namespace microswarm::experiment
