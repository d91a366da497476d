// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/predictive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/world/world.hpp"
#include "tests/navigation/late_drive.hpp"

namespace microswarm::navigation {
namespace {

using PredictiveDrive = LateDrive<PredictiveNavigator>;

TEST(Predictive, GoesStraightInTheOpen) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon}) {
    PredictiveDrive drive{.swarm = swarm};
    drive.run(40);
    EXPECT_TRUE(drive.arrived);
    EXPECT_LT(drive.time, 1600 / 70.0 + 1);
    EXPECT_FALSE(drive.was(NavigatorState::avoid) || drive.was(NavigatorState::escape) ||
                 drive.was(NavigatorState::hold));
  }
}

TEST(Predictive, LetsWhatIsThreeTimesAsFastCross) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon})
    for (const double y : {-900.0, -600.0, -300.0, 1300.0}) {
      // It crosses the straight way when the swarm is there.
      const Vec2 from{900, y};
      const double meets_at = 10;
      const Vec2 velocity{0, (500 - y) / meets_at};
      PredictiveDrive drive{.obstacles = {{DiscShape{80}, Straight{from, velocity}}},
                            .swarm = swarm};
      drive.run(60);
      EXPECT_TRUE(drive.arrived);
      EXPECT_GT(drive.min_gap, 0) << y;
      EXPECT_LT(drive.time, 30) << y;
    }
}

TEST(Predictive, StepsAsideOfWhatComesHeadOn) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon})
    for (const double faster : {1.0, 2.0, 3.0}) {
      PredictiveDrive drive{
          .obstacles = {{DiscShape{100}, Straight{{1900, 500}, {-70 * faster, 0}}}},
          .swarm = swarm};
      drive.run(60);
      EXPECT_TRUE(drive.arrived);
      EXPECT_GT(drive.min_gap, 0) << faster;
      EXPECT_LT(drive.time, 30) << faster;
    }
}

TEST(Predictive, GoesRoundAWallAndLetsAnObstaclePassInTheGap) {
  const std::vector<Polygon> walls{{{{980, 0}, {1020, 0}, {1020, 620}, {980, 620}}, {}}};
  for (const double period : {6.0, 9.0}) {
    PredictiveDrive drive{
        .walls = walls,
        .obstacles = {{DiscShape{60}, HarmonicLine{{1000, 850}, {300, 0}, period, 0.2}}}};
    drive.run(120);
    EXPECT_TRUE(drive.arrived);
    EXPECT_GT(drive.min_gap, 0) << period;
  }
}

TEST(Predictive, HoldsOrLeavesRatherThanBeRunOver) {
  // A broad bar that sweeps the room leaves a gap at one side only, and turns back at its ends.
  PredictiveDrive drive{
      .obstacles = {{BoxShape{80, 560}, HarmonicLine{{900, 280}, {500, 0}, 30, 0.25}}}};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
  EXPECT_TRUE(drive.was(NavigatorState::avoid));
}

TEST(Predictive, GivesWayBeforeItsGoal) {
  PredictiveDrive drive{.obstacles = {{DiscShape{60}, HarmonicLine{room_goal, {0, 300}, 8, 0}}}};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(Predictive, ThroughAChannelWithMovingWalls) {
  DeformingChannel channel;
  channel.centre_line = {{150, 500}, {700, 400}, {1200, 600}, {1850, 500}};
  channel.half_width = 120;
  channel.end_half_width = 140;
  channel.amplitude = 20;
  channel.block_centre = {1000, 500};
  channel.block_height = 1100;
  PredictiveDrive drive{.obstacles = {{channel, Still{{0, 0}, 0}}}};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(Predictive, ArrivesAmongWhatSwings) {
  PredictiveDrive drive{
      .obstacles = {{DiscShape{80}, HarmonicLine{{900, 500}, {100, 300}, 9, 0}},
                    {BoxShape{90, 60}, HarmonicArc{{1300, 500}, 200, 0, 2, 12, 0}}}};
  drive.run(60);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(Predictive, HoldsWhenBlindAndGoesOn) {
  const World world{std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, std::vector<Polygon>{}),
                    {{DiscShape{60}, Straight{{900, 0}, {0, 50}}}}};
  PredictiveNavigator navigator({}, body_task(slow_vortex), Rng(1, Purpose::planner));
  const Snapshot frame = world.at(0);
  navigator.prepare(frame, {});
  const Observation good{.now = 0,
                         .seen = 0,
                         .swarm = SwarmPose{{{200, 500}, 0}, 50},
                         .robots = {},
                         .world = borrowed(frame)};
  EXPECT_GT(navigator.step(good, {}).speed, 0);
  Observation bad = good;
  bad.now = 0.1;
  bad.seen = 0.1;
  bad.swarm.reset();
  EXPECT_EQ(navigator.step(bad, {}).speed, 0);
  EXPECT_EQ(navigator.view().state, NavigatorState::blind);
  EXPECT_TRUE(navigator.view().path.empty());
  bad = good;
  bad.now = 3;
  EXPECT_EQ(navigator.step(bad, {}).speed, 0) << "stale";
  bad.seen = 3;
  bad.swarm->pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(navigator.step(bad, {}).speed, 0);
  const Snapshot later = world.at(3.1);
  Observation again = good;
  again.now = again.seen = 3.1;
  again.world = borrowed(later);
  EXPECT_GT(navigator.step(again, {}).speed, 0);
  again.swarm->pose.position = room_goal;
  EXPECT_EQ(navigator.step(again, {}).speed, 0);
  EXPECT_EQ(navigator.view().state, NavigatorState::arrived);
}

// Windows and bounds that come in an order name the two that are not in it.
TEST(Predictive, RefusesWindowsAndBoundsOutOfOrder) {
  EXPECT_TRUE(validate(PredictiveParams{}).empty());
  PredictiveParams no_speeds;
  no_speeds.tuning.speed_shares.clear();
  EXPECT_EQ(validate(no_speeds).size(), 1u);
  const auto refused = [](auto&& change) {
    PredictiveParams params;
    change(params.prediction.tuning);
    const Issues issues = validate(params);
    EXPECT_EQ(issues.size(), 1u);
    return issues.empty() ? std::string() : issues[0].text;
  };
  const auto names = [](const std::string& text, const std::string& a, const std::string& b) {
    EXPECT_NE(text.find(a + " must be less than"), std::string::npos) << text;
    EXPECT_NE(text.find(b), std::string::npos) << text;
  };
  names(refused([](auto& t) { t.oscillation.short_window = t.oscillation.medium_window; }),
        "short_window_s", "medium_window_s");
  names(refused([](auto& t) { t.oscillation.long_window = t.oscillation.medium_window; }),
        "medium_window_s", "long_window_s");
  names(refused([](auto& t) { t.oscillation.max_frequency = t.oscillation.min_frequency; }),
        "min_frequency_per_s", "max_frequency_per_s");
  names(refused([](auto& t) { t.recurrence.min_age = t.recurrence.max_time_offset; }),
        "max_time_offset_s", "min_age_s");
}

}  // namespace
}  // namespace microswarm::navigation
