// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/route.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/rng.hpp"

namespace microswarm {
namespace {

// A wall from below with a gap at the top.
Map with_wall() {
  return Map({{0, 0}, {1000, 500}}, {{.outer = {{490, 0}, {510, 0}, {510, 400}, {490, 400}}}});
}

TEST(Route, LeadsThroughTheGap) {
  const Map map = with_wall();
  const Vec2 goal{900, 100};
  const Route route(map, goal, 20, 10);
  Vec2 p{100, 100};
  double way = route.way_from(p);
  EXPECT_GT(way, 1000);
  EXPECT_LT(way, 1200);
  for (int i = 0; i < 100 && distance(p, goal) > 15; ++i) {
    const Vec2 next = route.ahead(map, p, 60, 15);
    ASSERT_FALSE(next == p) << "stuck at " << p.x << ", " << p.y;
    EXPECT_TRUE(map.is_free(Segment{p, next}, 15));
    EXPECT_LT(route.way_from(next), way + 1e-3);
    way = route.way_from(next);
    p = next;
  }
  EXPECT_LE(distance(p, goal), 15);
}

TEST(Route, KnowsWhenThereIsNoWay) {
  const Map map({{0, 0}, {1000, 500}}, {{.outer = {{490, 0}, {510, 0}, {510, 500}, {490, 500}}}});
  const Route route(map, {900, 100}, 20, 10);
  EXPECT_TRUE(std::isinf(route.way_from({100, 100})));
  EXPECT_EQ(route.ahead(map, {100, 100}, 60, 15), (Vec2{100, 100}));
}

TEST(Route, AGoalOutsideOrInAWallGivesNoWay) {
  const Map map = with_wall();
  EXPECT_TRUE(std::isinf(Route(map, {2000, 100}, 20, 10).way_from({100, 100})));
  EXPECT_TRUE(std::isinf(Route(map, {500, 100}, 20, 10).way_from({100, 100})));
}

TEST(Route, AFineGridIsCoarsenedToItsLimit) {
  const Map map = with_wall();
  const Route route(map, {900, 100}, 20, 0.01, 10'000);
  EXPECT_FALSE(std::isinf(route.way_from({100, 100})));
}

}  // namespace
}  // namespace microswarm
