// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/pieces.hpp"

#include <gtest/gtest.h>

#include <set>

#include "microswarm/world/obstacles/clip.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

const Polygon& polygon_of(const Body& body) { return std::get<Polygon>(body.shape); }

std::vector<Body> pieces(std::vector<Polygon> polygons, const std::vector<Disc>& discs = {}) {
  for (Polygon& p : polygons) p = normalised(p);
  return connected_pieces(polygons, discs);
}

int count_of(const std::vector<Body>& bodies) {
  std::set<std::uint32_t> numbers;
  for (const Body& b : bodies) numbers.insert(b.obstacle);
  return static_cast<int>(numbers.size());
}

TEST(Pieces, rectangles_that_overlap_or_share_an_edge_become_one) {
  for (const Polygon& other :
       {rectangle(50, 50, 150, 150), rectangle(100, 0, 200, 100), rectangle(100, 20, 200, 80),
        rectangle(0, 0, 100, 100), rectangle(-10, 40, 110, 60)}) {
    const auto bodies = pieces({rectangle(0, 0, 100, 100), other});
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_TRUE(polygon_of(bodies[0]).holes.empty());
  }
  const auto cross = pieces({rectangle(0, 40, 100, 60), rectangle(40, 0, 60, 100)});
  EXPECT_EQ(area(polygon_of(cross[0])), 3600);
  EXPECT_EQ(polygon_of(cross[0]).outer.size(), 12u);
}

TEST(Pieces, a_wall_within_a_wall_vanishes_but_not_within_its_hole) {
  Polygon ring = rectangle(0, 0, 100, 100);
  ring.holes = {{{20, 20}, {80, 20}, {80, 80}, {20, 80}}};
  EXPECT_EQ(pieces({rectangle(0, 0, 100, 100), rectangle(30, 30, 40, 40)}).size(), 1u);
  const auto island = pieces({ring, rectangle(30, 30, 40, 40)});
  EXPECT_EQ(island.size(), 2u);
  EXPECT_EQ(count_of(island), 2);
  EXPECT_EQ(pieces({rectangle(2, 2, 10, 10), ring}).size(), 1u);
}

TEST(Pieces, frame_of_four_rectangles_has_a_hole) {
  const auto frame = pieces({rectangle(0, 0, 100, 10), rectangle(0, 90, 100, 100),
                             rectangle(0, 0, 10, 100), rectangle(90, 0, 100, 100)});
  ASSERT_EQ(frame.size(), 1u);
  EXPECT_EQ(polygon_of(frame[0]).holes.size(), 1u);
  EXPECT_EQ(area(polygon_of(frame[0])), 3600);
}

TEST(Pieces, a_touch_in_a_point_connects_and_keeps_the_bits) {
  const std::vector<Polygon> corner_to_corner{rectangle(0.1, 0.1, 0.3, 0.3),
                                              rectangle(0.3, 0.3, 0.7, 0.7)};
  const auto bodies = pieces(corner_to_corner);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(count_of(bodies), 1);
  EXPECT_EQ(polygon_of(bodies[0]).outer, corner_to_corner[0].outer);
  const auto tip_on_edge =
      pieces({rectangle(0, 0, 100, 100), {{{100, 50}, {150, 40}, {150, 60}}, {}}});
  EXPECT_EQ(tip_on_edge.size(), 2u);
  EXPECT_EQ(count_of(tip_on_edge), 1);
}

TEST(Pieces, a_crossing_through_a_vertex_is_an_overlap) {
  // The tip pierces the edge exactly at a vertex of the other ring.
  const Polygon notched{{{0, 0}, {100, 0}, {100, 50}, {100, 100}, {0, 100}}, {}};
  const Polygon wedge{{{80, 50}, {150, 40}, {150, 60}}, {}};
  const auto bodies = pieces({notched, wedge});
  EXPECT_EQ(bodies.size(), 1u);
}

TEST(Pieces, discs_join_what_they_touch_and_stay_discs) {
  const auto bodies = pieces({rectangle(0, 0, 100, 100), rectangle(300, 0, 400, 100)},
                             {{{110, 50}, 10}, {{125, 50}, 5}, {{50, 50}, 5}, {{600, 0}, 5}});
  ASSERT_EQ(bodies.size(), 6u);
  const std::vector<std::uint32_t> expected{0, 1, 0, 0, 0, 2};
  for (std::size_t i = 0; i < bodies.size(); ++i) EXPECT_EQ(bodies[i].obstacle, expected[i]);
}

TEST(Pieces, a_ring_that_crosses_itself_is_mended) {
  const auto bow = pieces({{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}, {}}});
  ASSERT_FALSE(bow.empty());
  EXPECT_EQ(count_of(bow), 1);
  double sum = 0;
  for (const Body& b : bow) sum += area(polygon_of(b));
  EXPECT_NEAR(sum, 5000, 1e-6);
}

TEST(Pieces, a_wall_without_area_stays) {
  const auto bodies = pieces({{{{0, 0}, {50, 50}, {100, 100}}, {}}, rectangle(40, 40, 60, 60)});
  EXPECT_EQ(bodies.size(), 2u);
  EXPECT_EQ(count_of(bodies), 1);
}

TEST(Pieces, of_random_walls_cover_the_same_points) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 60; ++world) {
    const Drawn drawn = crowded(rng, 2 + world, world % 5);
    const auto bodies = pieces(drawn.polygons, drawn.discs);
    for (int i = 0; i < 500; ++i) {
      const Vec2 p = random_point(rng, drawn.bounds);
      double d = 1e9;
      for (const Body& b : bodies) {
        d = std::min(d, std::visit([&](const auto& shape) { return distance(p, shape); }, b.shape));
      }
      EXPECT_NEAR(d, drawn.to_walls(p), 1e-8);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto* a = std::get_if<Polygon>(&bodies[i].shape);
        const auto* b = std::get_if<Polygon>(&bodies[j].shape);
        if (a && b) {
          EXPECT_EQ(locate(*a, b->outer[0]) == Side::inside, false);
        }
      }
    }
  }
}

TEST(Pieces, connect_exactly_what_touches) {
  Rng rng(2, Purpose::test);
  for (int world = 0; world < 40; ++world) {
    Drawn drawn;  // on a coarse raster, so that corners and edges meet often
    for (int i = 0; i < 30; ++i) {
      const double x = 10.0 * static_cast<double>(rng.below(20));
      const double y = 10.0 * static_cast<double>(rng.below(20));
      drawn.polygons.push_back(rectangle(x, y, x + 10.0 * static_cast<double>(1 + rng.below(3)),
                                         y + 10.0 * static_cast<double>(1 + rng.below(3))));
    }
    const std::size_t n = drawn.polygons.size();
    std::vector<std::size_t> group(n);
    for (std::size_t i = 0; i < n; ++i) group[i] = i;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!bounding_box(drawn.polygons[i]).overlaps(bounding_box(drawn.polygons[j]))) continue;
        const std::size_t from = group[i], to = group[j];
        for (std::size_t& g : group) g = g == from ? to : g;
      }
    }
    const std::set<std::size_t> expected(group.begin(), group.end());
    const auto bodies = pieces(drawn.polygons);
    EXPECT_EQ(count_of(bodies), static_cast<int>(expected.size()));
    double sum = 0;
    for (const Body& b : bodies) sum += area(polygon_of(b));
    double raster = 0;
    for (int x = 0; x < 25; ++x) {
      for (int y = 0; y < 25; ++y) {
        raster += drawn.to_walls(Vec2{10.0 * x + 5, 10.0 * y + 5}) == 0 ? 100 : 0;
      }
    }
    EXPECT_NEAR(sum, raster, 1e-6);
  }
}

TEST(Clip, difference_keeps_islands_and_bits) {
  const auto free = difference({{0, 0}, {100, 100}}, std::vector{rectangle(0.1, 10, 99.9, 20)});
  ASSERT_EQ(free.size(), 1u);
  ASSERT_EQ(free[0].holes.size(), 1u);
  EXPECT_EQ(std::count(free[0].holes[0].begin(), free[0].holes[0].end(), Vec2{0.1, 10}), 1);
  EXPECT_EQ(difference({{0, 0}, {100, 100}}, std::vector{rectangle(0, 10, 100, 20)}).size(), 2u);
  EXPECT_TRUE(difference({{0, 0}, {1, 1}}, std::vector{rectangle(-1, -1, 2, 2)}).empty());
}

}  // namespace
}  // namespace microswarm
