// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/shapes.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "tests/geometry/frame.hpp"

#include <gtest/gtest.h>

#include <array>

namespace microswarm {
namespace {

TEST(Vec2, TurnsAndAngles) {
  const double pi = 3.141592653589793;
  EXPECT_EQ(perpendicular({1, 0}), (Vec2{0, 1}));
  EXPECT_EQ(heading_along({0, 0}), 0);
  EXPECT_NEAR(heading_along(rotated({2, 0}, 1.25)), 1.25, 1e-15);
  EXPECT_NEAR(norm(rotated({3, 4}, pi / 3)), 5, 1e-15);
  EXPECT_GT(cross({1, 0}, {0, 1}), 0);
}

TEST(Box, EmptyContainsNothing) {
  const Box box;
  EXPECT_FALSE(box.contains({0, 0}));
  EXPECT_FALSE(box.overlaps({{-1, -1}, {1, 1}}));
}

TEST(Box, TouchingBoxesOverlap) {
  const Box box{{0, 0}, {1, 2}};
  EXPECT_TRUE(box.contains({1, 2}));
  EXPECT_TRUE(box.overlaps({{1, 2}, {3, 3}}));
  EXPECT_FALSE(box.overlaps({{1.5, 0}, {3, 3}}));
  EXPECT_EQ(box.grown(1).width(), 3);
  EXPECT_EQ(box.centre(), (Vec2{0.5, 1}));
}

TEST(Polygon, AreaLessHoles) {
  EXPECT_EQ(area(frame), 64);
  EXPECT_EQ(signed_area(frame.outer), 100);
  EXPECT_EQ(signed_area(frame.holes[0]), -36);
  EXPECT_EQ(bounding_box(frame).width(), 10);
}

TEST(Polygon, SmallAreasFarOutKeepTheirDigits) {
  const std::vector<Vec2> ring{{1e9, 1e9}, {1e9 + 1, 1e9}, {1e9 + 1, 1e9 + 1}, {1e9, 1e9 + 1}};
  EXPECT_EQ(signed_area(ring), 1);
}

TEST(UniformIn, PointsAheadAreThoseDrawn) {
  const Box box{{-3, 7}, {11, 8}};
  Rng rng(1, Purpose::test);
  for (std::size_t i = 0; i < 1000; ++i) {
    std::array<Vec2, Rng::max_ahead / 2> ahead;
    look_ahead(box, rng, ahead);
    Rng copy = rng;
    for (const Vec2 p : ahead) ASSERT_EQ(p, uniform_in(box, copy));
    rng.skip(i % (Rng::max_ahead + 1));
  }
}

TEST(Polygon, EveryEdgeOnce) {
  int count = 0;
  Vec2 sum;
  for_each_edge(frame, [&](Vec2 a, Vec2 b) {
    ++count;
    sum += b - a;
  });
  EXPECT_EQ(count, 8);
  EXPECT_EQ(sum, Vec2{});
  for_each_edge(Polygon{}, [](Vec2, Vec2) { FAIL(); });
}

TEST(Polygon, NormalisedTurnsRingsAndDropsRepeats) {
  const Polygon untidy{{{0, 0}, {0, 10}, {0, 10}, {10, 10}, {10, 0}, {0, 0}},
                       {{{2, 2}, {8, 2}, {8, 8}, {2, 8}, {2, 2}}, {{5, 5}, {5, 5}, {6, 5}}}};
  const Polygon tidy = normalised(untidy);
  EXPECT_EQ(tidy.outer.size(), 4u);
  EXPECT_GT(signed_area(tidy.outer), 0);
  ASSERT_EQ(tidy.holes.size(), 1u);
  EXPECT_EQ(tidy.holes[0].size(), 4u);
  EXPECT_LT(signed_area(tidy.holes[0]), 0);
  EXPECT_TRUE(normalised({{{0, 0}, {1, 1}, {0, 0}}, {}}).outer.empty());
}

}  // namespace
}  // namespace microswarm
