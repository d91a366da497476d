// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/distance_field.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

std::shared_ptr<const Map> shared(Map map) { return std::make_shared<const Map>(std::move(map)); }

TEST(DistanceField, EstimateIsTheDistanceInTheOpen) {
  const auto map = shared(Map({{0, 0}, {400, 300}}, {}));
  const Vec2 goal{333, 77};
  DistanceField field = DistanceField::over(*map, goal);
  Rng rng(1, Purpose::test);
  for (int k = 0; k < 500; ++k) {
    const double x = rng.uniform(0, 400);
    const Vec2 p{x, rng.uniform(0, 300)};
    EXPECT_GE(field.estimate(p), distance(p, goal) - 5);
    EXPECT_LE(field.estimate(p), distance(p, goal) + 5);
  }
}

TEST(DistanceField, EstimateGoesAroundWalls) {
  // A wall from below, open for 50 above.
  const auto map = shared(Map({{0, 0}, {200, 200}}, {scenes::rectangle({{95, 0}, {105, 150}})}));
  DistanceField field = DistanceField::over(*map, {150, 10});
  EXPECT_NEAR(field.estimate({50, 10}), 10 + 2 * norm(Vec2{45, 140}), 28);
}

TEST(DistanceField, EstimateIsFarBehindWalls) {
  const auto map = shared(Map({{0, 0}, {200, 200}}, {scenes::rectangle({{95, 0}, {105, 200}})}));
  DistanceField field = DistanceField::over(*map, {150, 10});
  EXPECT_GT(field.estimate({50, 10}), 400);
}

TEST(DistanceField, ALengthThatAStopLeftOpenIsAskedForAnew) {
  const auto map = shared(Map({{0, 0}, {200, 200}}, {scenes::rectangle({{95, 0}, {105, 150}})}));
  DistanceField field = DistanceField::to_goal(map, {150, 10}, 5, 5);
  DistanceField whole = DistanceField::to_goal(map, {150, 10}, 5, 5);
  const std::atomic<bool> flag = true;
  field.stop_with(Stop(&flag));
  EXPECT_GT(field.from({50, 10}), whole.from({50, 10}));
  field.stop_with({});
  EXPECT_EQ(field.from({50, 10}), whole.from({50, 10}));
}

TEST(DistanceField, OfManyCornersIsALittleLonger) {
  std::vector<Polygon> walls;
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 6000; ++i) {
    const double x = rng.uniform(0, 2000);
    const Vec2 p{x, rng.uniform(0, 2000)};
    walls.push_back(scenes::rectangle({p, p + Vec2{4, 4}}));
  }
  const auto map = shared(Map({{0, 0}, {2000, 2000}}, walls));
  ASSERT_GT(map->corners().all().size(), DistanceField::max_exact_corners);
  const Vec2 goal{1000, 1000};
  DistanceField field = DistanceField::over(*map, goal);
  ShortestPaths exact(*map, 0);
  int asked = 0;
  for (int k = 0; k < 8; ++k) {
    const double x = rng.uniform(700, 1300);
    const Vec2 p{x, rng.uniform(700, 1300)};
    if (!field.reaches(p) || !map->is_free(p, 0)) continue;
    ++asked;
    const double length = exact.find(p, goal).length;
    EXPECT_GE(field.estimate(p), length - 25);
    EXPECT_LE(field.estimate(p), 1.12 * length + 25);
  }
  EXPECT_GT(asked, 4);
}

// A wall from below with a gap at the top.
Map with_wall() {
  return Map({{0, 0}, {1000, 500}}, {{.outer = {{490, 0}, {510, 0}, {510, 400}, {490, 400}}}});
}

TEST(DistanceField, LeadsThroughTheGap) {
  const auto map = shared(with_wall());
  const Vec2 goal{900, 100};
  DistanceField route = DistanceField::to_goal(map, goal, 20, 10);
  Vec2 p{100, 100};
  double way = route.from(p);
  EXPECT_GT(way, 1000);
  EXPECT_LT(way, 1200);
  for (int i = 0; i < 100 && distance(p, goal) > 15; ++i) {
    const Vec2 next = route.ahead(p, 60);
    ASSERT_FALSE(next == p) << "stuck at " << p.x << ", " << p.y;
    EXPECT_TRUE(map->is_free(Segment{p, next}, 15));
    EXPECT_LT(route.from(next), way + 1e-3);
    way = route.from(next);
    p = next;
  }
  EXPECT_LE(distance(p, goal), 15);
}

TEST(DistanceField, KnowsWhenThereIsNoWay) {
  const auto map =
      shared(Map({{0, 0}, {1000, 500}}, {{.outer = {{490, 0}, {510, 0}, {510, 500}, {490, 500}}}}));
  DistanceField route = DistanceField::to_goal(map, {900, 100}, 20, 10);
  EXPECT_TRUE(std::isinf(route.from({100, 100})));
  EXPECT_EQ(route.ahead({100, 100}, 60), (Vec2{100, 100}));
}

TEST(DistanceField, AGoalOutsideOrInAWallGivesNoWay) {
  const auto map = shared(with_wall());
  EXPECT_TRUE(std::isinf(DistanceField::to_goal(map, {2000, 100}, 20, 10).from({100, 100})));
  EXPECT_TRUE(std::isinf(DistanceField::to_goal(map, {500, 100}, 20, 10).from({100, 100})));
}

TEST(DistanceField, AFineGridIsCoarsenedToItsLimit) {
  const auto map = shared(with_wall());
  DistanceField route = DistanceField::to_goal(map, {900, 100}, 20, 0.01, 10'000);
  EXPECT_FALSE(std::isinf(route.from({100, 100})));
}

}  // namespace
}  // namespace microswarm::planning
