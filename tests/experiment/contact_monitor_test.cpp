// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/monitors/contact_monitor.hpp"

#include <gtest/gtest.h>

#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

using Way = std::vector<PoseStamped>;

TEST(ContactMonitor, SeesADiscThatFliesThroughTheSwarmBetweenTwoTicks) {
  Scenario scenario = open_room();
  // At 100 µm per ms it is far away on both sides at the ticks.
  scenario.obstacles = {disc(10, Straight{.start = {1000, -4000}, .velocity = {0, 90000}})};
  const World world = world_of(scenario);
  ContactMonitor watch(world);
  const Way way{{0, {{1000, 500}, 0}, 40}, {0.1, {{1000, 500}, 0}, 40}};
  const auto touches = watch.follow(0, way);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, EventKind::contact_obstacle);
  EXPECT_EQ(touches[0].body, 0u);
  EXPECT_EQ(touches[0].speed, 0);
  EXPECT_NEAR(touches[0].t, 0.05 - 50 / 90000.0, 1e-6);
  EXPECT_EQ(watch.obstacles().clearance, 0);
}

TEST(ContactMonitor, ADiscThatAppearsOnTheSwarmTouchesItThen) {
  World world = world_of(open_room());
  Track track{"tracks.csv", "1", {}};
  track.samples = std::make_shared<const Samples>(Samples{{0.043, 9}, {{1000, 500}, {1100, 500}}});
  world.obstacles = {disc(10, track)};
  ContactMonitor watch(world);
  const Way way{{0, {{1000, 500}, 0}, 40}, {0.1, {{1000, 500}, 0}, 40}};
  const auto touches = watch.follow(0, way);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_NEAR(touches[0].t, 0.043, 1e-3);
  EXPECT_LT(touches[0].clearance, 40);
}

TEST(ContactMonitor, LeastDistanceIsThatOfTheClosedForm) {
  Rng rng(3, Purpose::test);
  World world = world_of(open_room());
  for (int i = 0; i < 300; ++i) {
    const Vec2 start{rng.uniform(200, 1800), rng.uniform(200, 800)};
    const Vec2 velocity{rng.uniform(-200, 200), rng.uniform(-200, 200)};
    const Vec2 from{rng.uniform(300, 1700), rng.uniform(300, 700)};
    const Vec2 swarm_velocity{rng.uniform(-80, 80), rng.uniform(-80, 80)};
    world.obstacles = {disc(30, Straight{start, velocity})};
    ContactMonitor watch(world);
    double least = 1e9;
    Vec2 p = from;
    bool touched = false;
    for (int tick = 0; tick < 10; ++tick) {
      const Vec2 q = p + 0.1 * swarm_velocity;
      touched |= !watch.follow(0.1 * tick, Way{{0, {p, 0}, 20}, {0.1, {q, 0}, 20}}).empty();
      p = q;
    }
    const Vec2 gap = start - from, closing = velocity - swarm_velocity;
    const double when = std::clamp(-dot(gap, closing) / squared_norm(closing), 0.0, 1.0);
    least = std::max(0.0, norm(gap + when * closing) - 30);
    EXPECT_NEAR(watch.obstacles().clearance, least, 2 * ContactMonitor::resolution);
    if (std::abs(least - 20) > 0.1) {
      EXPECT_EQ(touched, least < 20) << i;
    }
  }
}

TEST(ContactMonitor, LeastDistanceToABreathingDisc) {
  Scenario scenario = open_room();
  scenario.obstacles = {
      {BreathingDisc{.min_radius = 50, .max_radius = 150, .period = 0.4}, Still{{1000, 500}, 0}}};
  const World world = world_of(scenario);
  ContactMonitor watch(world);
  for (int tick = 0; tick < 8; ++tick)
    watch.follow(0.1 * tick, Way{{0, {{1200, 500}, 0}, 40}, {0.1, {{1200, 500}, 0}, 40}});
  EXPECT_NEAR(watch.obstacles().clearance, 50, 0.05);
}

TEST(ContactMonitor, ATouchThatLastsIsOneEvent) {
  Scenario scenario = open_room();
  scenario.obstacles = {
      disc(50, HarmonicLine{.centre = {1000, 500}, .amplitude = {0, 200}, .period = 10})};
  const World world = world_of(scenario);
  ContactMonitor watch(world);
  std::size_t touches = 0;
  for (int tick = 0; tick < 200; ++tick)
    touches += watch.follow(0.1 * tick, Way{{0, {{1000, 500}, 0}, 40}, {0.1, {{1000, 500}, 0}, 40}})
                   .size();
  EXPECT_EQ(touches, 5u);  // it begins on the swarm and comes back every half period
}

TEST(ContactMonitor, WallsAndBorder) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {
      {{999, 0}, {1000, 0}, {1000, 900}, {999, 900}}};
  const World world = world_of(scenario);
  ContactMonitor watch(world);
  // One jump over a wall of 1 µm: both ends are clear.
  auto touches = watch.follow(0, Way{{0, {{900, 500}, 0}, 40}, {0.1, {{1100, 500}, 0}, 40}});
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].kind, EventKind::contact_wall);
  EXPECT_EQ(touches[0].body, 0u);
  EXPECT_EQ(watch.walls().clearance, 0);

  ContactMonitor other(world);
  EXPECT_TRUE(other.follow(0, Way{{0, {{1200, 100}, 0}, 40}, {0.1, {{1200, 50}, 0}, 40}}).empty());
  touches = other.follow(0.1, Way{{0, {{1200, 50}, 0}, 40}, {0.1, {{1200, 30}, 0}, 40}});
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].body, border_body);
  EXPECT_EQ(other.walls().clearance, 30);
}

TEST(ContactMonitor, ASwarmThatWidensTouchesWhatItDidNotReach) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(50, Still{{1000, 500}, 0})};
  const World world = world_of(scenario);
  ContactMonitor watch(world);
  EXPECT_TRUE(watch.follow(0, Way{{0, {{1100, 500}, 0}, 40}, {0.1, {{1100, 500}, 0}, 40}}).empty());
  EXPECT_NEAR(watch.min_gap(), 10, 1e-9);
  const auto touches =
      watch.follow(0.1, Way{{0, {{1100, 500}, 0}, 40}, {0.1, {{1100, 500}, 0}, 60}});
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_NEAR(touches[0].t, 0.15, 0.001);
  EXPECT_NEAR(watch.min_gap(), -10, 1e-9);
  EXPECT_NEAR(watch.obstacles().clearance, 50, 1e-9);
}

}  // namespace
}  // namespace microswarm::experiment
