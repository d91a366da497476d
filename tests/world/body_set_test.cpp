// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/body_set.hpp"

#include <gtest/gtest.h>

#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

std::vector<Body> bodies_of(const Drawn& drawn) {
  std::vector<Body> out;
  for (const Polygon& p : drawn.polygons) out.push_back({.shape = normalised(p)});
  for (const Disc& d : drawn.discs) out.push_back({.shape = d});
  return out;
}

void expect_as_brute_force(const Drawn& drawn, const BodySet& set, Rng& rng, int queries) {
  for (int i = 0; i < queries; ++i) {
    const Vec2 p = random_point(rng, drawn.bounds.grown(200));
    const Segment s{p, p + random_point(rng, {{-100, -100}, {100, 100}})};
    const double limit = i % 3 == 0 ? 1e9 : 60;
    const double at = drawn.to_walls(p);
    EXPECT_EQ(set.clearance(p, limit), std::min(limit, at));
    EXPECT_EQ(set.holds(p), at == 0);
    const double along = drawn.to_walls(s);
    EXPECT_NEAR(set.clearance(s, limit), std::min(limit, along), 1e-12);
    const double r = i % 2 == 0 ? 0 : rng.uniform(0, 100);
    EXPECT_EQ(set.is_free(p, r), is_free_at(at, r));
    if (std::abs(along - r) > 1e-9) {
      EXPECT_EQ(set.is_free(s, r), is_free_at(along, r));
    }
    const Segment far{p, random_point(rng, drawn.bounds.grown(200))};
    const double along_far = drawn.to_walls(far);
    if (std::abs(along_far - r) > 1e-9) {
      EXPECT_EQ(set.is_free(far, r), is_free_at(along_far, r));
    }
    if (at > 0) {
      EXPECT_EQ(set.is_free_from_outside(s, r), set.is_free(s, r));
    }

    const std::size_t nearest = set.nearest(p, limit);
    if (at >= limit) {
      EXPECT_EQ(nearest, set.bodies().size());
    } else {
      ASSERT_LT(nearest, set.bodies().size());
      EXPECT_NEAR(std::max(0.0, -depth_in(set.bodies()[nearest], p)), at, 1e-12);
    }
  }
}

TEST(BodySet, answers_as_brute_force_for_few_and_many_bodies) {
  Rng rng(1, Purpose::test);
  BodySet reused;
  for (const int n : {0, 1, 3, 12, 60, 200}) {
    for (const auto& [stars, discs] : {std::pair{n, 0}, {0, n}, {n, n}}) {
      const Drawn drawn = crowded(rng, stars, discs);
      const std::vector<Body> bodies = bodies_of(drawn);
      expect_as_brute_force(drawn, BodySet(bodies), rng, 600);
      reused.assign(bodies);
      expect_as_brute_force(drawn, reused, rng, 100);
    }
  }
}

TEST(BodySet, discs_of_very_different_size_and_no_size) {
  Rng rng(2, Purpose::test);
  Drawn drawn;
  for (int i = 0; i < 100; ++i) {
    drawn.discs.push_back({random_point(rng, drawn.bounds), std::pow(10.0, rng.uniform(-3, 2.5))});
  }
  drawn.discs.push_back({{5000, 5000}, 0});
  expect_as_brute_force(drawn, BodySet(bodies_of(drawn)), rng, 3000);
  EXPECT_FALSE(BodySet(bodies_of(drawn)).is_free(Vec2{5000, 5000}, 0));
  Drawn column;
  for (int i = 0; i < 40; ++i) column.discs.push_back({{500, 10.0 * i}, 0});
  expect_as_brute_force(column, BodySet(bodies_of(column)), rng, 1000);
}

TEST(BodySet, is_empty) {
  const BodySet set;
  EXPECT_TRUE(set.empty());
  EXPECT_TRUE(set.is_free(Vec2{0, 0}, 1e9));
  EXPECT_EQ(set.clearance(Vec2{0, 0}, 7), 7);
  EXPECT_EQ(set.nearest({0, 0}, 1e9), 0u);
  EXPECT_FALSE(set.holds({0, 0}));
}

TEST(BodySet, visits_each_edge_and_disc_near_a_box_once) {
  Rng rng(3, Purpose::test);
  for (const int n : {3, 100}) {
    const Drawn drawn = crowded(rng, n, n);
    const BodySet set(bodies_of(drawn));
    for (int i = 0; i < 200; ++i) {
      const Vec2 p = random_point(rng, drawn.bounds);
      const Box box{p, p + random_point(rng, {{0, 0}, {200, 200}})};
      std::vector<int> seen(drawn.discs.size(), 0);
      set.discs().for_each_in(box, [&](std::size_t k) { ++seen[k]; });
      for (std::size_t k = 0; k < seen.size(); ++k) {
        EXPECT_LE(seen[k], 1);
        const Disc& d = drawn.discs[k];
        if (box.overlaps(Box{d.centre, d.centre}.grown(d.radius))) {
          EXPECT_EQ(seen[k], 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace microswarm
