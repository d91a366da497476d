// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/snapshot.hpp"

#include <gtest/gtest.h>

#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

TEST(Snapshot, joins_walls_border_and_moving_bodies) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 10; ++world) {
    const Drawn walls = orchard(rng, 6, 4);
    const Drawn moving = crowded(rng, 4, 6);
    std::vector<Body> bodies;
    for (const Polygon& p : moving.polygons) bodies.push_back({.shape = normalised(p)});
    for (const Disc& d : moving.discs) bodies.push_back({.shape = d});
    const Snapshot now(std::make_shared<Map>(walls.map()), 3, bodies);
    std::vector<Vec2> positions;
    for (int i = 0; i < 3000; ++i) positions.push_back(random_point(rng, walls.bounds.grown(10)));
    std::vector<std::uint8_t> free(positions.size());
    now.are_free(positions, 25, free);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec2 p = positions[i];
      EXPECT_EQ(free[i], now.is_free(p, 25));
      EXPECT_EQ(now.clearance(p), std::min(walls.clearance(p), moving.to_walls(p)));
      EXPECT_EQ(now.obstacle_clearance(p), std::min(walls.to_walls(p), moving.to_walls(p)));
      const double r = rng.uniform(0, 60);
      EXPECT_EQ(now.is_free(p, r), is_free_at(now.clearance(p), r));
      EXPECT_EQ(now.blocked_reason(p, r).empty(), now.is_free(p, r));
    }
  }
}

TEST(Snapshot, a_polyline_is_free_when_every_piece_is) {
  Rng rng(2, Purpose::test);
  const Drawn walls = orchard(rng, 8, 4);
  const Snapshot now(std::make_shared<Map>(walls.map()), 0,
                     {{.shape = Disc{{1000, 500}, 80}}, {.shape = Disc{{300, 300}, 50}}});
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vec2> line{random_point(rng, walls.bounds)};
    while (line.size() < 8) line.push_back(line.back() + random_point(rng, {{-8, -8}, {12, 12}}));
    const double r = rng.uniform(0, 60);
    bool expected = true;
    for (std::size_t k = 1; k < line.size(); ++k) {
      expected = expected && now.is_free(Segment{line[k - 1], line[k]}, r);
    }
    EXPECT_EQ(now.is_free(std::span<const Vec2>(line), r), expected);
  }
  EXPECT_TRUE(now.is_free(std::span<const Vec2>{}, 10));
  const std::vector<Vec2> point{{1000, 500}};
  EXPECT_FALSE(now.is_free(std::span<const Vec2>(point), 0));
}

TEST(Snapshot, a_polyline_beside_moving_polygons_too) {
  Rng rng(5, Purpose::test);
  const Box bounds{{0, 0}, {2000, 1000}};
  std::vector<Body> bodies{{.shape = Disc{{1000, 500}, 80}, .obstacle = 0}};
  for (std::uint32_t i = 1; i < 25; ++i)
    bodies.push_back({.shape = random_star(rng, random_point(rng, bounds), 90), .obstacle = i});
  const Snapshot now(std::make_shared<Map>(bounds, std::vector<Polygon>{}), 0, bodies);
  int free = 0, open = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vec2> line{random_point(rng, bounds)};
    while (line.size() < 12) line.push_back(line.back() + random_point(rng, {{-4, -4}, {8, 8}}));
    const double r = rng.uniform(1, 60);
    bool expected = true;
    for (std::size_t k = 1; k < line.size(); ++k)
      expected = expected && now.is_free(Segment{line[k - 1], line[k]}, r);
    EXPECT_EQ(now.is_free(std::span<const Vec2>(line), r), expected);
    free += expected;
    if (!now.is_open(line[0], r)) continue;
    ++open;
    EXPECT_TRUE(now.is_free(line[0], r));
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(open, 1000);
}

TEST(Snapshot, says_why_a_point_is_blocked) {
  Drawn walls;
  walls.polygons = {rectangle(1500, 700, 1600, 800), rectangle(500, 400, 700, 600)};
  walls.discs = {{{1000, 300}, 50}};
  const Snapshot now(std::make_shared<Map>(walls.map()), 0,
                     {{.shape = Disc{{300, 500}, 60}, .obstacle = 0},
                      {.shape = rectangle(800, 800, 900, 900), .obstacle = 1}});
  EXPECT_EQ(now.blocked_reason({100, 100}, 40), "");
  EXPECT_EQ(now.blocked_reason({512, 500}, 40), "is 12 µm inside wall 2");
  EXPECT_EQ(now.blocked_reason({493, 500}, 40), "is 7 µm from wall 2, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({1000, 270}, 40), "is 20 µm inside wall 3");
  EXPECT_EQ(now.blocked_reason({1000, 225}, 40), "is 25 µm from wall 3, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({300, 433}, 40), "is 7 µm from obstacle 1, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({850, 810}, 40), "is 10 µm inside obstacle 2");
  EXPECT_EQ(now.blocked_reason({-5, 100}, 0), "is outside the map (0..2000 × 0..1000 µm)");
  EXPECT_EQ(now.blocked_reason({100, 7}, 40), "is 7 µm from the border, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({100, 0}, 0), "touches the border");
  EXPECT_EQ(now.blocked_reason({500, 500}, 0), "touches wall 2");
  EXPECT_EQ(now.blocked_reason({460.0004, 500}, 40), "is 39.9996 µm from wall 2, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({460.04, 500}, 40), "is 39.96 µm from wall 2, needs 40 µm");
  EXPECT_EQ(now.blocked_reason({464.6, 500}, 40), "is 35 µm from wall 2, needs 40 µm");
}

}  // namespace
}  // namespace microswarm
