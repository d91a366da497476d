// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/local_target.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "microswarm/core/maths/rng.hpp"
#include "tests/cases.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

LocalTargetQuery towards(Vec2 from, double heading, Vec2 goal, double clearance = 40) {
  return {.swarm = {from, heading},
          .goal_heading = heading_along(goal - from),
          .goal_distance = distance(from, goal),
          .previous_target = {},
          .clearance = clearance,
          .min_distance = 20};
}

TEST(LocalTarget, InTheOpenItLiesTowardsTheGoal) {
  const auto target = select_local_target(room_with(), towards({500, 500}, 0, {1800, 500}), {});
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->position.y, 500, 1);
  EXPECT_GT(target->position.x, 600);
}

TEST(LocalTarget, NeverFartherThanTheBaseDistanceOrTheGoal) {
  const LocalTargetParams params;
  for (double goal_x : {520.0, 600.0, 1800.0}) {
    const auto target =
        select_local_target(room_with(), towards({500, 500}, 0, {goal_x, 500}), params);
    ASSERT_TRUE(target);
    EXPECT_LE(distance(target->position, Vec2{500, 500}),
              std::min(params.base_distance, goal_x - 500) + 1e-9);
  }
}

TEST(LocalTarget, TheWayThereIsFree) {
  Rng rng(2, Purpose::test);
  int found = 0;
  for (int i = 0; i < test::cases(300); ++i) {
    std::vector<Body> bodies;
    for (std::uint32_t k = 0; k < 12; ++k)
      bodies.push_back(
          {.shape = Disc{{rng.uniform(0, 2000), rng.uniform(0, 1000)}, rng.uniform(20, 100)},
           .obstacle = k});
    const Snapshot world = room_with({}, bodies);
    const Vec2 from{rng.uniform(100, 1900), rng.uniform(100, 900)};
    const auto target =
        select_local_target(world, towards(from, rng.uniform(-3, 3), {1800, 500}), {});
    EXPECT_EQ(target.has_value() || !world.is_free(from, 40), true);
    if (!target) continue;
    ++found;
    EXPECT_TRUE(world.is_free(Segment{from, target->position}, 40));
  }
  EXPECT_GT(found, test::cases(100));
}

TEST(LocalTarget, ABlockedFanWidensToTheFullCircle) {
  // A dead end that opens only behind the swarm.
  const std::vector<Polygon> walls{{.outer = {{300, 300}, {700, 300}, {700, 420}, {300, 420}}},
                                   {.outer = {{300, 580}, {700, 580}, {700, 700}, {300, 700}}},
                                   {.outer = {{560, 420}, {700, 420}, {700, 580}, {560, 580}}}};
  const auto target =
      select_local_target(room_with(walls), towards({500, 500}, 0, {1800, 500}), {});
  ASSERT_TRUE(target);
  EXPECT_LT(target->position.x, 500);
}

TEST(LocalTarget, AClosedInSwarmHasNone) {
  const auto in_wall =
      select_local_target(room_with({{.outer = {{400, 400}, {600, 400}, {600, 600}, {400, 600}}}}),
                          towards({500, 500}, 0, {1800, 500}), {});
  EXPECT_FALSE(in_wall);
}

TEST(LocalTarget, AStoppedSearchHasNone) {
  const std::atomic<bool> flag = true;
  const auto query = towards({500, 500}, 0, {1800, 500});
  EXPECT_TRUE(select_local_target(room_with(), query, {}));
  EXPECT_FALSE(select_local_target(room_with(), query, {}, Stop(&flag)));
}

}  // namespace
}  // namespace microswarm::navigation
