// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/free_goal.hpp"

#include <gtest/gtest.h>

#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

TEST(FreeGoal, IsTheGoalItselfWhenThatIsFree) {
  scenes::RawWorld world;
  EXPECT_EQ(free_goal(world.snapshot(), {500, 350}, 50, 40), (Vec2{500, 350}));
}

TEST(FreeGoal, IsAFreePointWithinTheToleranceAndAboutTheNearest) {
  Rng rng(3, Purpose::test);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const scenes::RawWorld world = scenes::random_world(trial % scenes::random_kinds, rng);
    const Snapshot snapshot = world.snapshot();
    const double x = rng.uniform(0, 1000);
    const Vec2 goal{x, rng.uniform(0, 700)};
    const auto aim = free_goal(snapshot, goal, 60, 20);
    double nearest = 60;  // by a fine net of points
    for (double dx = -60; dx <= 60; dx += 3) {
      for (double dy = -60; dy <= 60; dy += 3) {
        const Vec2 p = goal + Vec2{dx, dy};
        if (distance(p, goal) < nearest && world.clearance(p) >= 21) nearest = distance(p, goal);
      }
    }
    if (aim) {
      ++found;
      EXPECT_LE(distance(*aim, goal), 60);
      EXPECT_GE(world.clearance(*aim), 20 - 1e-9);
      EXPECT_LE(distance(*aim, goal), nearest + 4);
    } else {
      EXPECT_GE(nearest, 57) << "trial " << trial;
    }
  }
  EXPECT_GT(found, 30);
}

TEST(FreeGoal, IsFoundInASpotThinnerThanTheSearch) {
  scenes::RawWorld world;  // its border is at y = 0
  const Snapshot snapshot = world.snapshot();
  for (const double thin : {1.0, 0.1, 1e-3, 1e-6}) {
    const Vec2 goal{500, 40 - 30 + thin};
    const auto aim = free_goal(snapshot, goal, 30, 40);
    ASSERT_TRUE(aim) << thin;
    EXPECT_LE(distance(*aim, goal), 30);
    EXPECT_TRUE(snapshot.is_free(*aim, 40));
  }
  EXPECT_FALSE(free_goal(snapshot, {500, 9.99}, 30, 40));
  // In a corner of two walls the spot is a tip.
  EXPECT_TRUE(free_goal(snapshot, Vec2{40, 40} - 29.9 * unit_vector(0.8), 30, 40));
  EXPECT_FALSE(free_goal(snapshot, Vec2{40, 40} - 30.1 * unit_vector(0.8), 30, 40));
}

TEST(PushedFree, HasTheClearanceAndIsBesideThePlace) {
  Rng rng(4, Purpose::test);
  int pushed = 0, not_pushed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Snapshot snapshot = scenes::random_world(trial % scenes::random_kinds, rng).snapshot();
    const Map& map = snapshot.map();
    for (int k = 0; k < 20; ++k) {
      const double x = rng.uniform(0, 1000);
      const Vec2 position{x, rng.uniform(0, 700)};
      const double has = map.clearance(position);
      const auto found = pushed_free(map, position, 20);
      if (has >= 20) {
        EXPECT_EQ(found, position);
        continue;
      }
      ++(found ? pushed : not_pushed);
      if (!found) continue;
      EXPECT_TRUE(map.is_free(*found, 20));
      EXPECT_GE(distance(*found, position), 20 - has - 1e-6);
    }
  }
  EXPECT_GT(pushed, 30);
  EXPECT_GT(not_pushed, 30);
  const Map empty({{0, 0}, {100, 100}}, {});
  EXPECT_EQ(pushed_free(empty, {-5, 50}, 10), std::nullopt);
  ASSERT_TRUE(pushed_free(empty, {5, 50}, 10));
  EXPECT_NEAR(pushed_free(empty, {5, 50}, 10)->x, 10, 1e-6);
}

TEST(FreeGoal, NamesTheFault) {
  scenes::RawWorld world;
  world.discs = {{{500, 350}, 200}};
  const Snapshot snapshot = world.snapshot();
  EXPECT_EQ(find_target(snapshot, {500, 350}, {100, 100}, 50, 40).fault, Status::start_blocked);
  EXPECT_EQ(find_target(snapshot, {100, 100}, {500, 350}, 50, 40).fault, Status::goal_blocked);
  EXPECT_EQ(find_target(snapshot, {100, 100}, {500, 130}, 50, 40).fault, std::nullopt);
  EXPECT_EQ(find_target(snapshot, {100, 100}, {500, 90}, 50, 40).fault, std::nullopt);
}

}  // namespace
}  // namespace microswarm::planning
