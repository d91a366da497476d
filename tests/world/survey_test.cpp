// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "microswarm/world/snapshot.hpp"
#include "tests/cases.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

/// Covered share of the circle by counting points of a raster.
double counted_area(const std::vector<Body>& bodies, Disc circle, int n) {
  const double step = 2 * circle.radius / n;
  int covered = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec2 p =
          circle.centre + Vec2{(i + 0.5) * step - circle.radius, (j + 0.5) * step - circle.radius};
      if (distance(p, circle.centre) > circle.radius) continue;
      for (const Body& b : bodies) {
        if (depth_in(b, p) < 0) continue;
        ++covered;
        break;
      }
    }
  }
  return covered * step * step;
}

void expect_as_counted(const Map& map, const std::vector<Body>& moving, Disc circle) {
  const Snapshot world(std::make_shared<Map>(map), 0, moving);
  std::vector<Body> all(map.walls().bodies().begin(), map.walls().bodies().end());
  std::map<std::pair<bool, std::uint32_t>, double> nearest;
  for (const Body& b : all) {
    const auto found = nearest.try_emplace({false, b.obstacle}, 1e9).first;
    found->second = std::min(found->second, std::max(0.0, -depth_in(b, circle.centre)));
  }
  for (const Body& b : moving) {
    const auto found = nearest.try_emplace({true, b.obstacle}, 1e9).first;
    found->second = std::min(found->second, std::max(0.0, -depth_in(b, circle.centre)));
    all.push_back(b);
  }
  const Survey seen = world.survey(circle);
  int obstacles = 0;
  double sum = 0;
  for (const auto& [name, d] : nearest) {
    if (d > circle.radius) continue;
    ++obstacles;
    sum += d;
  }
  EXPECT_EQ(seen.obstacles, obstacles);
  EXPECT_NEAR(seen.distance_sum, sum, 1e-9 * (1 + sum));
  const double whole = pi * circle.radius * circle.radius;
  EXPECT_NEAR(seen.covered_area / whole, counted_area(all, circle, 120) / whole, 8e-3);
}

std::vector<Body> random_moving(Rng& rng, const Drawn& drawn) {
  std::vector<Body> out;
  for (std::uint32_t i = 0; i < 8; ++i) {
    if (i % 2 == 0) {
      out.push_back(
          {.shape = Disc{random_point(rng, drawn.bounds), rng.uniform(20, 150)}, .obstacle = i});
    } else {
      out.push_back({.shape = normalised(random_star(rng, random_point(rng, drawn.bounds), 150)),
                     .obstacle = i / 2});
    }
  }
  return out;
}

TEST(Survey, counts_what_a_raster_counts) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 12; ++world) {
    const Drawn drawn = world % 2 == 0 ? crowded(rng, 8 * world, 3 * world) : orchard(rng, 8, 4);
    const Map map = drawn.map();
    const std::vector<Body> moving =
        world % 3 == 0 ? std::vector<Body>{} : random_moving(rng, drawn);
    for (int i = 0; i < test::cases(12); ++i) {
      expect_as_counted(map, moving, {random_point(rng, drawn.bounds), rng.uniform(20, 250)});
    }
  }
}

TEST(Survey, of_known_scenes) {
  Drawn drawn;
  drawn.polygons = {rectangle(500, 400, 700, 600)};
  const auto map = std::make_shared<Map>(drawn.map());
  const Survey half = Snapshot(map).survey({{500, 500}, 50});
  EXPECT_EQ(half.obstacles, 1);
  EXPECT_EQ(half.distance_sum, 0);
  EXPECT_NEAR(half.covered_area, 0.5 * pi * 2500, 1e-9);
  const Survey none = Snapshot(map).survey({{300, 500}, 100});
  EXPECT_EQ(none.obstacles, 0);
  EXPECT_EQ(none.covered_area, 0);
  EXPECT_EQ(Snapshot(map).survey({{5, 500}, 100}).obstacles, 0) << "the border is no obstacle";
  const Survey within = Snapshot(map).survey({{600, 500}, 20});
  EXPECT_EQ(within.obstacles, 1);
  EXPECT_NEAR(within.covered_area, pi * 400, 1e-9);
  // A moving body in the wall adds an obstacle but no area.
  const Snapshot both(map, 0, {{.shape = Disc{{600, 500}, 30}, .obstacle = 0}});
  const Survey twice = both.survey({{490, 500}, 150});
  EXPECT_EQ(twice.obstacles, 2);
  EXPECT_NEAR(twice.covered_area, Snapshot(map).survey({{490, 500}, 150}).covered_area, 1e-6);
  EXPECT_NEAR(twice.distance_sum, 10 + 80, 1e-9);
}

TEST(Survey, two_leaves_are_one_obstacle) {
  const auto map = std::make_shared<Map>(Drawn{}.map());
  const Snapshot world(map, 0,
                       {{.shape = rectangle(490, 550, 510, 600), .obstacle = 3},
                        {.shape = rectangle(490, 400, 510, 480), .obstacle = 3}});
  const Survey seen = world.survey({{500, 500}, 100});
  EXPECT_EQ(seen.obstacles, 1);
  EXPECT_NEAR(seen.distance_sum, 20, 1e-12);
  EXPECT_NEAR(seen.covered_area, 20 * 80 + 20 * 50 - 2 * 20 * 0.5, 30);
}

}  // namespace
}  // namespace microswarm
