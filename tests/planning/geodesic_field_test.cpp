// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/geodesic_field.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/rng.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm {
namespace {

TEST(GeodesicField, IsTheDistanceInTheOpenAndALittleMore) {
  const Map map({{0, 0}, {400, 300}}, {});
  const Vec2 goal{333, 77};
  const GeodesicField field(map, goal);
  Rng rng(1, Purpose::test);
  for (int k = 0; k < 500; ++k) {
    const double x = rng.uniform(0, 400);
    const Vec2 p{x, rng.uniform(0, 300)};
    EXPECT_GE(field.at(p), distance(p, goal) - 5);
    EXPECT_LE(field.at(p), 1.083 * distance(p, goal) + 5);
  }
}

TEST(GeodesicField, GoesAroundWalls) {
  // A wall from below, open for 50 above.
  const Map map({{0, 0}, {200, 200}}, {scenes::rectangle({{95, 0}, {105, 150}})});
  const GeodesicField field(map, {150, 10});
  EXPECT_NEAR(field.at({50, 10}), 10 + 2 * norm(Vec2{45, 140}), 28);
}

TEST(GeodesicField, BehindWallsItIsFar) {
  const Map map({{0, 0}, {200, 200}}, {scenes::rectangle({{95, 0}, {105, 200}})});
  const GeodesicField field(map, {150, 10});
  EXPECT_GT(field.at({50, 10}), 400);
}

}  // namespace
}  // namespace microswarm
