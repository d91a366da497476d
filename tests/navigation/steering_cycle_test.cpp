// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/steering_cycle.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/navigation/room.hpp"

namespace microswarm {
namespace {

Observation sighting(const Snapshot& world, Vec2 at, double now, double age) {
  return {.now = now,
          .seen = now - age,
          .swarm = SwarmPose{{at, 0}, 40},
          .robots = {},
          .world = borrowed(world)};
}

// Obstacles are predicted for the delay: then they are where they will be when the swarm is at the
// pose.
TEST(SteeringCycle, TheDelayIsTheTimeToThePoseAtEffect) {
  const Snapshot world = room_with();
  for (const double age : {0.0, 0.05, 0.2})
    for (const double lag : {0.0, 0.1, 0.3}) {
      SteeringCycle steering(
          {.radius = 40, .max_speed = 70, .max_turn_rate = 3, .response_lag = lag}, 50, room_goal,
          room_tolerance);
      for (int k = 0; k <= 20; ++k) {
        const Vec2 at{300 + 5.0 * k, 500};
        const Pose2* pose = steering.observe(sighting(world, at, 0.1 * k, age));
        ASSERT_TRUE(pose);
        if (k == 20) {
          EXPECT_NEAR(pose->position.x - at.x, 50 * steering.delay(), 1e-9) << age << ", " << lag;
          EXPECT_NEAR(steering.delay(), age + lag, 1e-12);
        }
        steering.command({0, 50}, NavigatorState::follow);
      }
    }
}

TEST(SteeringCycle, ACommandGivenInItsPlaceCountsAsItsOwn) {
  const Snapshot world = room_with();
  SteeringCycle steering({.radius = 40, .max_speed = 70, .max_turn_rate = 3, .response_lag = 0.3},
                         50, room_goal, room_tolerance);
  EXPECT_FALSE(steering.last_command());
  steering.overruled(0, {0, 0});
  steering.overruled(1, {0, 50});
  EXPECT_EQ(steering.last_command(), 1);
  const Pose2* pose = steering.observe(sighting(world, {300, 500}, 1.1, 0));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->position.x, 300 + 50 * 0.1, 1e-9);
  steering.command({1, 20}, NavigatorState::avoid);
  EXPECT_EQ(steering.last_command(), 1.1);
  EXPECT_EQ(steering.view().state, NavigatorState::avoid);
}

TEST(SteeringCycle, HoldsAtTheGoalAndWithoutASwarm) {
  const Snapshot world = room_with();
  SteeringCycle steering({.radius = 40, .max_speed = 70, .max_turn_rate = 3}, 100, room_goal,
                         room_tolerance);
  EXPECT_EQ(steering.speed(), 70) << "is never faster than the swarm";
  EXPECT_FALSE(steering.observe(sighting(world, room_goal + Vec2{29, 0}, 0, 0)));
  EXPECT_EQ(steering.hold().speed, 0);
  EXPECT_EQ(steering.view().state, NavigatorState::arrived);
  EXPECT_TRUE(steering.observe(sighting(world, room_goal + Vec2{31, 0}, 0.1, 0)));
  EXPECT_FALSE(steering.observe(sighting(world, {300, 500}, 3, 2.5))) << "the frame is too old";
  EXPECT_EQ(steering.hold().speed, 0);
  EXPECT_EQ(steering.view().state, NavigatorState::blind);
}

TEST(SteeringCycle, SeesASwarmWhoseEveryNumberIsGood) {
  const Snapshot world =
      room_with({Polygon{{{900, 400}, {1000, 400}, {1000, 600}, {900, 600}}, {}}});
  const SteeringCycle steering({.radius = 40, .max_speed = 70, .max_turn_rate = 3}, 50, room_goal,
                               room_tolerance);
  const Observation good = sighting(world, {300, 500}, 1, default_frame_timeout);
  EXPECT_TRUE(steering.sees_swarm(good));
  EXPECT_TRUE(steering.sees_swarm(sighting(world, {899.5, 500}, 1, 0))) << "beside a wall";
  const auto sees = [&](auto&& change) {
    Observation bad = good;
    change(bad);
    return steering.sees_swarm(bad);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sees([](Observation& o) { o.swarm.reset(); }));
  EXPECT_FALSE(sees([](Observation& o) { o.world = nullptr; }));
  EXPECT_FALSE(sees([](Observation& o) { o.swarm->pose.position.x = nan; }));
  EXPECT_FALSE(sees([](Observation& o) { o.swarm->pose.position.y = infinity; }));
  EXPECT_FALSE(sees([](Observation& o) { o.swarm->pose.heading = nan; }));
  EXPECT_FALSE(sees([](Observation& o) { o.swarm->radius = infinity; }));
  EXPECT_FALSE(sees([](Observation& o) { o.seen -= 0.01; })) << "too old";
  EXPECT_FALSE(sees([](Observation& o) { o.swarm->pose.position = {950, 500}; })) << "in a wall";
}

}  // namespace
}  // namespace microswarm
