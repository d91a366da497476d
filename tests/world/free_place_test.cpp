// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/free_place.hpp"

#include <gtest/gtest.h>

#include "tests/cases.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

TEST(FreePlace, IsFreeAndNearAndLeavesFreePlacesAlone) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 6; ++world) {
    const Drawn drawn = orchard(rng, 5 + world, 3 + world % 4);
    const Map map = drawn.map();
    for (int i = 0; i < test::cases(4000); ++i) {
      const double r = std::pow(10.0, rng.uniform(-3, 1));
      const Vec2 seen = random_point(rng, drawn.bounds.grown(50));
      const Vec2 found = free_place(map, seen, r);
      if (map.is_free(seen, r))
        ASSERT_EQ(found, seen);
      else
        ASSERT_TRUE(map.is_free(found, r));
    }
  }
}

TEST(FreePlace, BesideAWallIsAboutAsNearAsCanBe) {
  const Polygon block{{{{100, 100}, {200, 100}, {200, 200}, {100, 200}}}};
  const Map map({{0, 0}, {400, 300}}, {block});
  for (const double in : {0.01, 0.5, 3.0, 20.0}) {
    const Vec2 seen{150, 200 - in};
    const Vec2 found = free_place(map, seen, 0.002);
    EXPECT_GE(found.y, 200.002);
    EXPECT_LE(distance(found, seen), 1.3 * (in + 0.004)) << in;
  }
  const Vec2 outside{-3, 10};
  const Vec2 found = free_place(map, outside, 1);
  EXPECT_TRUE(map.is_free(found, 1));
  EXPECT_LE(distance(found, outside), 8.5);
}

TEST(FreePlace, WithoutOneItIsThatPlace) {
  const Map map({{0, 0}, {40, 30}}, {});
  EXPECT_EQ(free_place(map, {3, 4}, 100), (Vec2{3, 4}));
}

}  // namespace
}  // namespace microswarm
