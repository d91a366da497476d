// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_route.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

TEST(RadarRoute, GivenWaypointsAreVisitedInOrder) {
  const Map map(Box{{0, 0}, {3000, 1500}}, {});
  RadarRoute route({{1000, 1200}, {2000, 300}, {2700, 750}}, false);
  EXPECT_EQ(route.target(map, {300, 750}, 100, 20), (Vec2{1000, 1200}));
  EXPECT_EQ(route.target(map, {900, 1100}, 100, 20), (Vec2{1000, 1200}));
  EXPECT_EQ(route.target(map, {995, 1195}, 100, 20), (Vec2{2000, 300}));
  EXPECT_EQ(route.target(map, {1300, 1200}, 100, 20), (Vec2{2000, 300}));  // driven off
  EXPECT_EQ(route.target(map, {2040, 330}, 100, 20), (Vec2{2700, 750}));   // nearly, and beyond
}

TEST(RadarRoute, NeverRunsBack) {
  const Map map(Box{{0, 0}, {3000, 1500}}, {scenes::rectangle({{1400, 0}, {1450, 1000}})});
  RadarRoute route({{300, 1200}, {1300, 1250}, {1600, 1250}, {2300, 400}}, true);
  EXPECT_EQ(route.target(map, {300, 300}, 100, 20), (Vec2{1300, 1250}));  // the farthest seen
  EXPECT_TRUE(route.in_sight());
  EXPECT_EQ(route.target(map, {1290, 1250}, 100, 20), (Vec2{1600, 1250}));
  // Thrown back behind the wall: the next one stays, seen or not.
  EXPECT_EQ(route.target(map, {1200, 200}, 100, 20), (Vec2{1600, 1250}));
  EXPECT_FALSE(route.in_sight());
  EXPECT_EQ(route.target(map, {1800, 1250}, 100, 20), (Vec2{2300, 400}));
}

/// A room with a wall between start and goal, and a swarm of 100 µm in it that plans its path.
struct WalledRoom {
  RadarParams params{.global_plan = true};
  Snapshot world{
      std::make_shared<const Map>(Box{{0, 0}, {3000, 1500}},
                                  std::vector{scenes::rectangle({{1400, 0}, {1450, 1000}})}),
      0};
  Vec2 goal{2300, 400};
  double goal_tolerance = 20;

  RadarNavigator navigator() const {
    return RadarNavigator(
        params,
        body_task({.radius = 100, .max_speed = 85, .max_turn_rate = infinity, .response_lag = 0},
                  goal, goal_tolerance),
        Rng(1, Purpose::planner));
  }
  Observation sighting(Vec2 at, double now) const {
    return {.now = now,
            .seen = now,
            .swarm = SwarmPose{{at, 0}, 100},
            .robots = {},
            .world = borrowed(world)};
  }
};

TEST(RadarRoute, IsPlannedAgainWhereItIsOutOfSight) {
  const WalledRoom room;
  RadarNavigator navigator = room.navigator();
  const auto plans_at = [&](Vec2 at, double now) {
    navigator.step(room.sighting(at, now), {});
    return navigator.view().planned;
  };
  EXPECT_FALSE(navigator.view().plan);
  EXPECT_TRUE(plans_at({1200, 1250}, 0));
  EXPECT_TRUE(navigator.view().plan);
  EXPECT_FALSE(plans_at({1300, 1250}, 0.1));
  EXPECT_FALSE(plans_at({1800, 1250}, 0.2)) << "its next point is in sight";
  EXPECT_FALSE(plans_at({1000, 300}, 0.3)) << "thrown back behind the wall";
  EXPECT_FALSE(plans_at({1000, 300}, 0.9));
  EXPECT_TRUE(plans_at({1000, 300}, 1.01)) << "after the interval";
}

TEST(RadarRoute, EndsWhereTheGoalIsReached) {
  WalledRoom room;
  room.goal_tolerance = 4;
  room.params.planner.goal_tolerance = 150;
  RadarNavigator navigator = room.navigator();
  navigator.prepare(room.world, {});
  navigator.step(room.sighting({700, 400}, 0), {});
  ASSERT_FALSE(navigator.view().path.empty());
  EXPECT_LE(distance(navigator.view().path.back(), room.goal), room.goal_tolerance);
}

}  // namespace
}  // namespace microswarm::navigation
