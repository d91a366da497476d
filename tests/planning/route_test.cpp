// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/route.hpp"

#include <gtest/gtest.h>

#include "microswarm/geometry/uniform_in.hpp"
#include "random_worlds.hpp"

namespace microswarm::planning {
namespace {

TEST(Route, LeadsToTheGoalPastNineTenthsOfTheClearance) {
  Rng rng(21, Purpose::test);
  int arrived = 0;
  for (int world = 0; world < 40; ++world) {
    SCOPED_TRACE(world);
    const auto map = std::make_shared<const Map>(world % 2 ? crowded_map(rng) : random_map(rng));
    const double kept = rng.uniform(0.5, 3);
    const Vec2 goal = uniform_in(map->bounds(), rng);
    Route route(map, goal, kept);
    Vec2 p = uniform_in(map->bounds(), rng);
    if (route.length_from(p) == infinity) {
      EXPECT_EQ(route.ahead(p, 10), p);
      continue;
    }
    const double length = route.length_from(p);
    double gone = 0;
    // The first step may come out of a wall's clearance.
    for (int step = 0; step < 400 && !(p == goal); ++step) {
      const Vec2 next = route.ahead(p, 10);
      ASSERT_FALSE(next == p);
      EXPECT_LE(distance(p, next), 10 + 2 * kept);
      if (step > 0) {
        EXPECT_TRUE(map->is_free(Segment{p, next}, 0.9 * kept));
      }
      gone += distance(p, next);
      p = next;
    }
    EXPECT_EQ(p, goal);
    EXPECT_LE(gone, 1.01 * length + 1e-6);
    ++arrived;
  }
  EXPECT_GT(arrived, 20);
}

TEST(Route, TellsTheLengthFromInsideTheClearance) {
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {100, 100}}, std::vector<Polygon>{});
  Route route(map, {90, 50}, 10);
  EXPECT_NEAR(route.length_from({10, 50}), 80, 1e-9);
  EXPECT_NEAR(route.length_from({4, 50}), 86, 1e-6);
  EXPECT_EQ(Route().length_from({10, 50}), infinity);
  EXPECT_EQ(Route().ahead({10, 50}, 5), (Vec2{10, 50}));
}

TEST(Route, PassesWhatAGridWouldMiss) {
  // A gap that leaves 0.02 µm.
  const auto map = std::make_shared<const Map>(
      Box{{0, 0}, {100, 100}},
      std::vector<Polygon>{{.outer = {{49, -1}, {51, -1}, {51, 47.3}, {49, 47.3}}},
                           {.outer = {{49, 67.32}, {51, 67.32}, {51, 101}, {49, 101}}}});
  Route route(map, {90, 20}, 10);
  EXPECT_LT(route.length_from({10, 20}), 113);
  EXPECT_GT(route.length_from({10, 20}), 2 * norm(Vec2{40, 37.31}));
}

}  // namespace
}  // namespace microswarm::planning
