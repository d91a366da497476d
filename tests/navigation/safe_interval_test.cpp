// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/safe_interval.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/navigation/late_drive.hpp"

namespace microswarm::navigation {
namespace {

std::vector<Polygon> wall_with_gap(double low, double high) {
  return {{{{980, 0}, {1020, 0}, {1020, low}, {980, low}}, {}},
          {{{980, high}, {1020, high}, {1020, 1000}, {980, 1000}}, {}}};
}

TEST(SafeInterval, GoesStraightInTheOpen) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon}) {
    LateDrive<SafeIntervalNavigator> drive{.swarm = swarm};
    drive.run(40);
    EXPECT_TRUE(drive.arrived);
    EXPECT_LT(drive.time, 1600 / 70.0 + 1);
    EXPECT_LT(drive.turned, 0.1);
    EXPECT_FALSE(drive.was(NavigatorState::avoid) || drive.was(NavigatorState::escape) ||
                 drive.was(NavigatorState::hold) || drive.was(NavigatorState::wait));
  }
}

TEST(SafeInterval, LetsWhatIsThreeTimesAsFastCross) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon})
    for (const double y : {-900.0, -600.0, -300.0, 1300.0}) {
      // It crosses the straight way when the swarm is there.
      const Vec2 from{900, y};
      const Vec2 velocity{0, (500 - y) / 10};
      LateDrive<SafeIntervalNavigator> drive{
          .obstacles = {{DiscShape{80}, Straight{from, velocity}}}, .swarm = swarm};
      drive.run(60);
      EXPECT_TRUE(drive.arrived);
      EXPECT_GT(drive.min_gap, 0) << y;
      EXPECT_LT(drive.time, 30) << y;
    }
}

TEST(SafeInterval, StepsAsideOfWhatComesHeadOn) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon})
    for (const double faster : {1.0, 2.0, 3.0}) {
      LateDrive<SafeIntervalNavigator> drive{
          .obstacles = {{DiscShape{100}, Straight{{1900, 500}, {-70 * faster, 0}}}},
          .swarm = swarm};
      drive.run(60);
      EXPECT_TRUE(drive.arrived);
      EXPECT_GT(drive.min_gap, 0) << faster;
      EXPECT_LT(drive.time, 30) << faster;
    }
}

// A door closes for good; 400 µm beside it a gap stays open.
TEST(SafeInterval, LeavesAClosedDoorForAnOpenGap) {
  const std::vector<Polygon> walls{{{{980, 0}, {1020, 0}, {1020, 120}, {980, 120}}, {}},
                                   {{{980, 320}, {1020, 320}, {1020, 400}, {980, 400}}, {}},
                                   {{{980, 600}, {1020, 600}, {1020, 1000}, {980, 1000}}, {}}};
  const Waypoints closes{.points = {{1000, 740}, {1000, 500}}, .speed = 40, .at_end = AtEnd::stay};
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon}) {
    LateDrive<SafeIntervalNavigator> drive{
        .walls = walls, .obstacles = {{BoxShape{210, 30}, closes}}, .swarm = swarm};
    drive.run(60);
    EXPECT_TRUE(drive.arrived);
    EXPECT_GT(drive.min_gap, 0);
    EXPECT_LT(drive.time, 40);
  }
}

// A body that rests in the only way may go; in front of it the swarm waits.
TEST(SafeInterval, WaitsInFrontOfWhatRestsInTheOnlyWay) {
  LateDrive<SafeIntervalNavigator> drive{
      .walls = wall_with_gap(380, 620),
      .obstacles = {{BoxShape{240, 30}, Still{{1000, 500}, 0.5 * pi}}}};
  drive.run(25);
  EXPECT_FALSE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
  EXPECT_GT(drive.pose.position.x, 700) << "it goes as far as it can";
}

TEST(SafeInterval, WaitsForAValveAndGoesThrough) {
  const Valve valve{.span = 240, .thickness = 30, .min_gap = 0, .max_gap = 240, .period = 16};
  for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
    Valve now = valve;
    now.phase = phase;
    LateDrive<SafeIntervalNavigator> drive{.walls = wall_with_gap(380, 620),
                                           .obstacles = {{now, Still{{1000, 500}, 0}}}};
    drive.run(60);
    EXPECT_TRUE(drive.arrived) << phase;
    EXPECT_GT(drive.min_gap, 0) << phase;
    EXPECT_LT(drive.time, 24 + 16 + 4) << phase;
  }
}

// Behind a slower disc in a corridor that it fills: it follows without a change of mind.
TEST(SafeInterval, FollowsASlowerDiscSteadily) {
  const std::vector<Polygon> walls{{{{300, 0}, {1700, 0}, {1700, 420}, {300, 420}}, {}},
                                   {{{300, 580}, {1700, 580}, {1700, 1000}, {300, 1000}}, {}}};
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon}) {
    LateDrive<SafeIntervalNavigator> drive{
        .walls = walls,
        .obstacles = {{DiscShape{45}, Straight{{500, 500}, {35, 0}}}},
        .swarm = swarm};
    drive.run(90);
    EXPECT_TRUE(drive.arrived);
    EXPECT_GT(drive.min_gap, 0);
    EXPECT_LT(drive.turned / drive.time, radians(20));
  }
}

TEST(SafeInterval, ThroughAChannelWithMovingWalls) {
  DeformingChannel channel;
  channel.centre_line = {{150, 500}, {700, 400}, {1200, 600}, {1850, 500}};
  channel.half_width = 120;
  channel.end_half_width = 140;
  channel.amplitude = 20;
  channel.block_centre = {1000, 500};
  channel.block_height = 1100;
  LateDrive<SafeIntervalNavigator> drive{.obstacles = {{channel, Still{{0, 0}, 0}}}};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(SafeInterval, GivesWayBeforeItsGoal) {
  LateDrive<SafeIntervalNavigator> drive{
      .obstacles = {{DiscShape{60}, HarmonicLine{room_goal, {0, 300}, 8, 0}}}};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

// Lanes that are hardly wider than the swarm are found on a finer grid.
TEST(SafeInterval, FindsALaneHardlyWiderThanTheSwarm) {
  for (const double low : {440.0, 447.3}) {
    LateDrive<SafeIntervalNavigator> drive{.walls = wall_with_gap(low, low + 106)};
    drive.run(60);
    EXPECT_TRUE(drive.arrived) << low;
    EXPECT_GT(drive.min_gap, 0) << low;
  }
}

// Of a large map a cell may be wider than its passages: the way among walls is known all the same,
// and what comes through the passage passes first.
TEST(SafeInterval, FindsAPassageNarrowerThanItsCells) {
  SafeIntervalParams params;
  params.tuning.max_cells = 300;
  for (const bool comes : {false, true}) {
    std::vector<Obstacle> obstacles;
    if (comes) obstacles = {{DiscShape{30}, Straight{{1700, 900}, {-40, -7}}}};
    LateDrive<SafeIntervalNavigator> drive{
        .walls = wall_with_gap(750, 860), .obstacles = obstacles, .params = params};
    drive.run(60);
    EXPECT_TRUE(drive.arrived) << comes;
    EXPECT_GT(drive.min_gap, 0) << comes;
  }
}

// A swarm that makes more than its radius in a tick turns in lanes hardly wider than itself: what
// the next command can still avoid forbids no move.
TEST(SafeInterval, ASmallSwarmTurnsInNarrowLanes) {
  std::vector<Polygon> walls;
  for (int k = 0; k < 6; ++k) {
    const double x = 500.0 + 40 * k, door = k % 2 == 0 ? 480 : 520;
    walls.push_back({{{x, 0}, {x + 20, 0}, {x + 20, door - 10}, {x, door - 10}}, {}});
    walls.push_back({{{x, door + 10}, {x + 20, door + 10}, {x + 20, 1000}, {x, 1000}}, {}});
  }
  SafeIntervalParams params;
  params.speed = 80;
  LateDrive<SafeIntervalNavigator> drive{
      .walls = walls,
      .swarm = {.radius = 7, .max_speed = 80, .max_turn_rate = infinity},
      .params = params};
  drive.run(60);
  EXPECT_TRUE(drive.arrived);
}

TEST(SafeInterval, ArrivesAmongWhatSwings) {
  LateDrive<SafeIntervalNavigator> drive{
      .obstacles = {{DiscShape{80}, HarmonicLine{{900, 500}, {100, 300}, 9, 0}},
                    {BoxShape{90, 60}, HarmonicArc{{1300, 500}, 200, 0, 2, 12, 0}}}};
  drive.run(60);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(SafeInterval, TheSameRunGivesTheSameCommands) {
  const auto driven = [] {
    LateDrive<SafeIntervalNavigator> drive{
        .obstacles = {{DiscShape{80}, HarmonicLine{{900, 500}, {100, 300}, 9, 0}},
                      {DiscShape{60}, Straight{{1500, 100}, {-40, 30}}}}};
    drive.run(30);
    return drive.commands;
  };
  const auto first = driven();
  const auto again = driven();
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].heading, again[i].heading) << i;
    EXPECT_EQ(first[i].speed, again[i].speed) << i;
  }
}

TEST(SafeInterval, RefusesWindowsOutOfOrder) {
  EXPECT_TRUE(validate(SafeIntervalParams{}).empty());
  SafeIntervalParams params;
  params.prediction.tuning.oscillation.medium_window = 10;
  EXPECT_EQ(validate(params).size(), 1u);
}

}  // namespace
}  // namespace microswarm::navigation
