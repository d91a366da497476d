// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "microswarm/core/hash.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/swarm/swarm_body.hpp"
#include "microswarm/swarm/unicycle.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm {
namespace {

std::unique_ptr<Navigator> navigator(const Snapshot& world, std::uint64_t seed = 1) {
  auto made = make_navigator(HierarchicalParams{},
                             Task{.swarm = limits_of(RibbonParams{}),
                                  .robots = {},
                                  .goal = room_goal,
                                  .goal_tolerance = 30},
                             Rng(seed, Purpose::planner));
  made->prepare(world);
  return made;
}

Observation see(const Snapshot& world, Vec2 at, double heading = 0, double now = 0) {
  return {.now = now, .seen = now, .swarm = SwarmPose{{at, heading}, 40}, .world = &world};
}

TEST(Hierarchical, DrivesInTheOpen) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  const Command c = n->step(see(world, {300, 500}), {});
  EXPECT_GT(c.speed, 0);
  EXPECT_EQ(n->view().state, "follow");
  EXPECT_TRUE(n->view().planned);
  ASSERT_TRUE(n->view().local_target);
}

TEST(Hierarchical, HoldsWhenBlind) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  Observation none = see(world, {300, 500});
  none.swarm.reset();
  EXPECT_EQ(n->step(none, {}).speed, 0);
  EXPECT_EQ(n->view().state, "blind");
  Observation stale = see(world, {300, 500}, 0, 5);
  stale.seen = 4;
  EXPECT_EQ(n->step(stale, {}).speed, 0);
  Observation bad = see(world, {std::numeric_limits<double>::quiet_NaN(), 500}, 0, 6);
  EXPECT_EQ(n->step(bad, {}).speed, 0);
  Observation no_world = see(world, {300, 500}, 0, 7);
  no_world.world = nullptr;
  EXPECT_EQ(n->step(no_world, {}).speed, 0);
}

TEST(Hierarchical, HoldsAtTheGoal) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  EXPECT_EQ(n->step(see(world, {1790, 500}), {}).speed, 0);
  EXPECT_EQ(n->view().state, "arrived");
}

TEST(Hierarchical, HoldsWhenEverythingIsBlocked) {
  // A box just around the swarm: nowhere to go, and holding is as good as anything.
  const std::vector<Polygon> walls{{.outer = {{200, 380}, {400, 380}, {400, 400}, {200, 400}}},
                                   {.outer = {{200, 600}, {400, 600}, {400, 620}, {200, 620}}},
                                   {.outer = {{180, 380}, {200, 380}, {200, 620}, {180, 620}}},
                                   {.outer = {{400, 380}, {420, 380}, {420, 620}, {400, 620}}}};
  const Snapshot world = room_with(walls);
  const auto n = navigator(world);
  for (int k = 0; k < 5; ++k) {
    const Command c = n->step(see(world, {300, 500}, 0, 0.1 * k), {});
    if (c.speed <= 0) continue;
    const Pose2 next = unicycle_step({{300, 500}, 0}, c, 3, 0.1);
    EXPECT_TRUE(world.is_free(Segment{{300, 500}, next.position}, 80));
  }
}

TEST(Hierarchical, GetsOutOfTheWayOfWhatComesAtIt) {
  double x = 700;
  Pose2 pose{{300, 500}, 0};
  const Snapshot start =
      room_with({}, {{.shape = Disc{{x, 500}, 60}, .velocity = {-40, 0}, .obstacle = 0}});
  const auto n = navigator(start);
  double least = 1e9;
  for (int k = 0; k < 200; ++k) {
    const Snapshot world =
        room_with({}, {{.shape = Disc{{x, 500}, 60}, .velocity = {-40, 0}, .obstacle = 0}});
    const Command c = n->step(see(world, pose.position, pose.heading, 0.1 * k), {});
    pose = unicycle_step(pose, c, 3, 0.1);
    x -= 4;
    least = std::min(least, distance(pose.position, Vec2{x, 500}) - 60);
  }
  EXPECT_GE(least, 90 - 1e-6);
  EXPECT_LE(distance(pose.position, room_goal), 900);
}

std::uint64_t commands_hash(std::uint64_t seed) {
  const Snapshot world =
      room_with({}, {{.shape = Disc{{900, 480}, 120}, .velocity = {}, .obstacle = 0}});
  const auto n = navigator(world, seed);
  Pose2 pose{{300, 500}, 1};
  Hash hash;
  for (int k = 0; k < 150; ++k) {
    const Command c = n->step(see(world, pose.position, pose.heading, 0.1 * k), {});
    hash.value(c.heading);
    hash.value(c.speed);
    pose = unicycle_step(pose, c, 3, 0.1);
  }
  EXPECT_GT(pose.position.x, 700);
  return hash.digest();
}

TEST(Hierarchical, SameSeedSameBits) {
  EXPECT_EQ(commands_hash(5), commands_hash(5));
  EXPECT_NE(commands_hash(5), commands_hash(6));
}

}  // namespace
}  // namespace microswarm
