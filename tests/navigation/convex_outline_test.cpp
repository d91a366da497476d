// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/convex_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

Polygon convex_polygon(Rng& rng, Vec2 centre) {
  Polygon polygon;
  const int corners = 3 + static_cast<int>(rng.below(6));
  for (int k = 0; k < corners; ++k) {
    const double around = 2 * pi * (k + rng.uniform(0, 0.8)) / corners;
    polygon.outer.push_back(centre + 100 * unit_vector(wrap(around)));
  }
  return polygon;
}

TEST(ConvexOutline, IsAsFarAsTheBody) {
  Rng rng(5, Purpose::test);
  ConvexOutliner outliner;
  ConvexOutline outline;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec2 centre{rng.uniform(-500, 500), rng.uniform(-500, 500)};
    const Polygon polygon = convex_polygon(rng, centre);
    outliner.take({.shape = polygon}, outline);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p = centre + Vec2{rng.uniform(-300, 300), rng.uniform(-300, 300)};
      const double truth = distance(p, polygon);
      const double told = outline.distance_at(p - outline.centre);
      if (truth > 0)
        EXPECT_NEAR(told, truth, 1e-9);
      else
        EXPECT_LE(told, 1e-9);
    }
  }
}

TEST(ConvexOutline, OfManyPointsAsOfEach) {
  Rng rng(6, Purpose::test);
  ConvexOutliner outliner;
  ConvexOutline outline;
  for (int trial = 0; trial < 400; ++trial) {
    Body body{.shape = Disc{{10, 20}, 30}};
    if (trial % 4 > 0) body.shape = convex_polygon(rng, {10, 20});
    outliner.take(body, outline);
    const std::size_t count = rng.below(150);
    std::vector<double> x(count);
    std::vector<double> y(count);
    std::vector<double> told(count);
    for (std::size_t k = 0; k < count; ++k) {
      x[k] = k == 0 ? 0 : rng.uniform(-300, 300);
      y[k] = k == 0 ? 0 : rng.uniform(-300, 300);
    }
    outline.distances_at(x, y, told);
    for (std::size_t k = 0; k < count; ++k)
      ASSERT_EQ(told[k], outline.distance_at({x[k], y[k]})) << trial;
  }
}

TEST(ConvexOutline, OfADiscIsTheDisc) {
  ConvexOutliner outliner;
  ConvexOutline outline;
  outliner.take({.shape = Disc{{10, 20}, 30}}, outline);
  EXPECT_TRUE(outline.edges.empty());
  EXPECT_DOUBLE_EQ(outline.distance_at({50, 0}), 20);
  EXPECT_DOUBLE_EQ(outline.distance_at({0, 0}), -30);
}

TEST(ConvexOutline, HowHollowABodyMayBeIsTuned) {
  const Polygon angle{
      .outer = {{0, 0}, {100, 0}, {100, 10}, {10, 10}, {10, 100}, {0, 100}}};  // 0.62 hollow
  const std::vector<Vec2> inside{{40, 40}};
  const auto misleads = [&](const ConvexOutlineTuning& tuning, std::span<const Vec2> positions) {
    ConvexOutliner outliner(tuning);
    ConvexOutline outline;
    outliner.take({.shape = angle}, outline);
    return outliner.misleads(outline, positions);
  };
  EXPECT_TRUE(misleads({}, {}));
  EXPECT_FALSE(misleads({.max_hollow = 0.9}, {}));
  EXPECT_TRUE(misleads({.max_hollow = 0.9}, inside));
  EXPECT_FALSE(misleads({.ignored_hollow = 0.9}, inside));
}

}  // namespace
}  // namespace microswarm::navigation
