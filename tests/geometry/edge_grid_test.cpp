// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/core/maths/infinity.hpp"

#include <gtest/gtest.h>

#include <array>

#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

EdgeGrid grid_of(const std::vector<Segment>& edges, double cell = 0) {
  return {edges, std::vector<std::uint32_t>(edges.size(), 0), cell};
}

double brute_squared_distance(const std::vector<Segment>& edges, Vec2 p) {
  double best = infinity;
  for (const Segment& e : edges) best = std::min(best, squared_distance(p, e));
  return best;
}

bool brute_free(const std::vector<Segment>& edges, Segment s, double r) {
  for (const Segment& e : edges) {
    if (intersects(s, e) || squared_distance(s, e) < r * r) return false;
  }
  return true;
}

/// Every query of the grid beside its plain definition.
void expect_same_as_brute_force(const std::vector<Segment>& edges, const EdgeGrid& grid, Rng& rng,
                                const Box& box, int queries) {
  for (int i = 0; i < queries; ++i) {
    Vec2 p = random_point(rng, box);
    if (i % 4 == 0) p = edges[rng.below(edges.size())].a;
    const double d = brute_squared_distance(edges, p);
    EXPECT_EQ(grid.distance(p, infinity), std::sqrt(d));
    const double limit = 20 * rng.uniform();
    EXPECT_EQ(grid.distance(p, limit), std::min(limit, std::sqrt(d)));
    const std::size_t nearest = grid.nearest(p, infinity);
    ASSERT_LT(nearest, edges.size());
    EXPECT_EQ(squared_distance(p, edges[nearest]), d);
    for (std::size_t k = 0; k < nearest; ++k) ASSERT_GT(squared_distance(p, edges[k]), d);

    const double reach = i % 3 == 0 ? 1000.0 : 10.0;
    const Segment s{p, p + random_point(rng, {{-reach, -reach}, {reach, reach}})};
    const double r = i % 5 == 0 ? 0 : std::pow(10.0, rng.uniform(-6, 2));
    EXPECT_EQ(grid.capsule_free(s, r), brute_free(edges, s, r));
    // A capsule around a point, with radii at and beside the distance as well.
    for (const double at : {r, std::sqrt(d), std::nextafter(std::sqrt(d), infinity), 0.0})
      EXPECT_EQ(grid.capsule_free({p, p}, at), brute_free(edges, {p, p}, at)) << at;
    double segment_distance = infinity;
    for (const Segment& e : edges) {
      segment_distance = std::min(segment_distance, squared_distance(s, e));
    }
    EXPECT_EQ(grid.distance(s, infinity), std::sqrt(segment_distance));
    EXPECT_EQ(grid.distance(s, limit), std::min(limit, std::sqrt(segment_distance)));

    const Box window{{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)},
                     {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}};
    std::vector<int> seen(edges.size(), 0);
    grid.for_each_in(window, [&](std::size_t e) { ++seen[e]; });
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::array<Vec2, 2> ends{edges[e].a, edges[e].b};
      ASSERT_LE(seen[e], 1);
      const std::array<Vec2, 4> c{window.lo, Vec2{window.hi.x, window.lo.y}, window.hi,
                                  Vec2{window.lo.x, window.hi.y}};
      bool meets = window.contains(ends[0]);
      for (int k = 0; k < 4; ++k) meets = meets || intersects(edges[e], {c[k], c[(k + 1) % 4]});
      if (meets) {
        ASSERT_EQ(seen[e], 1);
      }
    }
  }
}

TEST(EdgeGrid, EmptyIsFreeEverywhere) {
  const EdgeGrid grid;
  EXPECT_EQ(grid.distance(Vec2{1, 2}, 7), 7);
  EXPECT_EQ(grid.distance(Segment{{1, 2}, {3, 4}}, 7), 7);
  EXPECT_EQ(grid.nearest({1, 2}, 7), 0u);
  EXPECT_FALSE(grid.in_solid({1, 2}));
  EXPECT_TRUE(grid.capsule_free({{0, 0}, {1, 1}}, 100));
  grid.for_each_in({{0, 0}, {1, 1}}, [](std::size_t) { FAIL(); });
}

TEST(EdgeGrid, RandomPolygonsAgreeWithBruteForce) {
  Rng rng(1, Purpose::test);
  EdgeGrid grid;
  for (int world = 0; world < 40; ++world) {
    std::vector<Polygon> polygons;
    const std::size_t count = 1 + rng.below(30);
    for (std::size_t i = 0; i < count; ++i) {
      polygons.push_back({random_star(rng, random_point(rng, {{0, 0}, {2000, 1000}}),
                                      std::pow(10.0, rng.uniform(0, 2.5))),
                          {}});
    }
    const std::vector<Segment> edges = edges_of(polygons);
    grid.assign(edges, std::vector<std::uint32_t>(edges.size(), 0),
                world % 3 == 0 ? rng.uniform(5, 3000) : 0);
    expect_same_as_brute_force(edges, grid, rng, {{-500, -500}, {2500, 1500}}, 60);
    for (int i = 0; i < 300; ++i) {
      Vec2 p = random_point(rng, grid.box().grown(10));
      if (i % 3 == 0) p = edges[rng.below(edges.size())].b;
      if (i % 3 == 1) {
        const Segment e = edges[rng.below(edges.size())];
        p = 0.5 * (e.a + e.b);
      }
      bool solid = false;
      for (const Polygon& polygon : polygons) solid |= locate(polygon, p) != Side::outside;
      EXPECT_EQ(grid.in_solid(p), solid) << p.x << ' ' << p.y;
    }
  }
}

TEST(EdgeGrid, TracedPixelsAgreeWithThePixels) {
  Rng rng(2, Purpose::test);
  for (int world = 0; world < 60; ++world) {
    const int size = 1 + static_cast<int>(rng.below(12));
    auto dark = random_pixels(rng, size, rng.uniform());
    dark.emplace(0, 0);
    const double pixel = world % 2 == 0 ? 1 : 0.5;
    const Vec2 origin = world % 3 == 0 ? Vec2{} : Vec2{-3.5, 1000.25};
    const auto edges = traced_pixels(dark, pixel, origin);
    const EdgeGrid grid = grid_of(edges, world % 4 == 0 ? 0.25 * double(1 + rng.below(16)) : 0);
    expect_same_as_brute_force(edges, grid, rng, grid.box().grown(3), 20);
    auto is_dark = [&](double x, double y) {
      return dark.contains({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))});
    };
    for (int y = -1; y <= 4 * size + 1; ++y) {
      for (int x = -1; x <= 4 * size + 1; ++x) {
        const Vec2 at{x / 4.0, y / 4.0};
        bool solid = false;
        for (const double dx : {-0.01, 0.01}) {
          for (const double dy : {-0.01, 0.01}) solid |= is_dark(at.x + dx, at.y + dy);
        }
        EXPECT_EQ(grid.in_solid(origin + pixel * at), solid) << at.x << ' ' << at.y;
      }
    }
  }
}

TEST(EdgeGrid, HolesAreFreeAndTheirEdgesSolid) {
  const Polygon frame{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}};
  const EdgeGrid grid = grid_of(edges_of({frame}));
  EXPECT_TRUE(grid.in_solid({1, 5}));
  EXPECT_TRUE(grid.in_solid({2, 5}));
  EXPECT_FALSE(grid.in_solid({5, 5}));
  EXPECT_FALSE(grid.in_solid({11, 5}));
  EXPECT_EQ(grid.distance(Vec2{5, 5}, infinity), 3);
}

TEST(EdgeGrid, ThinWallsAreNeverSteppedOver) {
  Rng rng(3, Purpose::test);
  for (const double thickness : {1.0, 1e-3, 1e-6}) {
    const Polygon wall{{{100, 0}, {100 + thickness, 0}, {100 + thickness, 1000}, {100, 1000}}, {}};
    const auto edges = edges_of({wall});
    for (const double cell : {0.0, 3.0, 400.0}) {
      const EdgeGrid grid = grid_of(edges, cell);
      for (int i = 0; i < 500; ++i) {
        const Vec2 from = random_point(rng, {{-900, 0}, {99, 1000}});
        const Vec2 to = random_point(rng, {{101.5, 0}, {1000, 1000}});
        EXPECT_FALSE(grid.capsule_free({from, to}, 0));
        EXPECT_FALSE(grid.capsule_free({from, to}, 1e-200));
        EXPECT_FALSE(grid.capsule_free({to, from}, 40));
        EXPECT_TRUE(grid.in_solid({100 + thickness * rng.uniform(), from.y}));
      }
    }
  }
}

TEST(EdgeGrid, TouchingIsContactOnlyWithoutRadius) {
  const Polygon box{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const EdgeGrid grid = grid_of(edges_of({box}));
  EXPECT_FALSE(grid.capsule_free({{10, 20}, {10, 10}}, 0));
  EXPECT_TRUE(grid.capsule_free({{10, 20}, {10, std::nextafter(10, 11)}}, 0));
  EXPECT_TRUE(grid.capsule_free({{-5, 15}, {20, 15}}, 5));
  EXPECT_FALSE(grid.capsule_free({{-5, 15}, {20, 15}}, std::nextafter(5, 6)));
}

TEST(EdgeGrid, FlatAndPointLikeSetsWork) {
  Rng rng(4, Purpose::test);
  const std::vector<std::vector<Segment>> sets = {
      {{{3, 4}, {3, 4}}},
      {{{0, 0}, {10, 0}}, {{10, 0}, {0, 0}}},
      {{{5, -1e3}, {5, 1e3}}, {{5, 1e3}, {5, -1e3}}},
      {{{1e9, 1e9}, {1e9 + 1, 1e9}}, {{1e9 + 1, 1e9}, {1e9, 1e9 + 1e-6}}},
  };
  for (const auto& edges : sets) {
    const EdgeGrid grid = grid_of(edges);
    expect_same_as_brute_force(edges, grid, rng, grid.box().grown(7), 40);
    EXPECT_TRUE(grid.in_solid(edges[0].a));
  }
}

TEST(EdgeGrid, FarPointsAreExact) {
  const Polygon box{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const EdgeGrid grid = grid_of(edges_of({box}), 1);
  EXPECT_EQ(grid.distance(Vec2{-1e6, 5}, infinity), 1e6);
  EXPECT_EQ(grid.distance(Vec2{5, 1e6 + 10}, infinity), 1e6);
  EXPECT_EQ(grid.distance(Vec2{13, 14}, 5.5), 5);
  EXPECT_EQ(grid.nearest({5, 14}, 4), 3u);
  EXPECT_EQ(grid.nearest({5, 14}, std::nextafter(4, 3)), 4u);
}

}  // namespace
}  // namespace microswarm
