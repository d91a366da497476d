// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/clearance_field.hpp"

#include <gtest/gtest.h>

#include "tests/each_target.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

/// Distance to the nearest wall or the border; depth in a wall or outside counts negative.
double signed_clearance(const Box& bounds, const BodySet& bodies, Vec2 p) {
  double least =
      std::min({p.x - bounds.lo.x, bounds.hi.x - p.x, p.y - bounds.lo.y, bounds.hi.y - p.y});
  double to_edge = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (const Body& body : bodies.bodies()) {
    if (const auto* disc = std::get_if<Disc>(&body.shape)) {
      least = std::min(least, distance(p, disc->centre) - disc->radius);
    } else {
      const double d = signed_distance(p, std::get<Polygon>(body.shape));
      to_edge = std::min(to_edge, std::abs(d));
      inside = inside || d < 0;
    }
  }
  return std::min(least, inside ? -to_edge : to_edge);
}

void expect_bracket(const Drawn& drawn, double cell, Rng& rng, int queries) {
  const Map map = drawn.map(cell);
  const ClearanceField& field = map.field();
  for (int i = 0; i < queries; ++i) {
    Vec2 p = random_point(rng, drawn.bounds);
    if (i % 3 == 0 && !drawn.polygons.empty()) {
      const auto& ring = drawn.polygons[rng.below(drawn.polygons.size())].outer;
      p = ring[rng.below(ring.size())] + random_point(rng, {{-3, -3}, {3, 3}});
    }
    if (!drawn.bounds.contains(p)) {
      EXPECT_LT(field.lower(p), 0);
      continue;
    }
    const double exact = signed_clearance(drawn.bounds, map.walls(), p);
    EXPECT_LE(field.lower(p), exact);
    EXPECT_GE(field.lower(p) + field.spread(), exact);
    double to_wall = std::numeric_limits<double>::infinity();
    for (const Body& body : map.walls().bodies()) {
      const auto* disc = std::get_if<Disc>(&body.shape);
      to_wall =
          std::min(to_wall, disc ? distance(p, *disc)
                                 : std::abs(signed_distance(p, std::get<Polygon>(body.shape))));
    }
    if (exact > 0) {
      EXPECT_EQ(field.wall_distance(p), to_wall);
    }
    EXPECT_EQ(map.clearance(p), std::max(0.0, exact));
  }
}

TEST(ClearanceField, brackets_the_exact_clearance_everywhere) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 12; ++world) {
    expect_bracket(crowded(rng, 10 * world, 8 * (world % 3)), 0, rng, 2000);
    expect_bracket(orchard(rng, 8, 4), 5 + 20 * rng.uniform(), rng, 2000);
  }
}

TEST(ClearanceField, has_the_same_bits_with_vectors_of_every_width) {
  Rng rng(4, Purpose::test);
  for (const Drawn& drawn : {crowded(rng, 60, 30), crowded(rng, 0, 40), orchard(rng, 8, 4)}) {
    std::vector<Vec2> positions;
    for (int i = 0; i < 5000; ++i) positions.push_back(random_point(rng, drawn.bounds));
    std::vector<double> first;
    test::for_each_target([&](const char* target) {
      SCOPED_TRACE(target);
      const Map map = drawn.map();
      std::vector<double> found;
      for (const Vec2 p : positions) {
        found.push_back(map.field().lower(p));
        found.push_back(map.field().wall_distance(p));
      }
      if (first.empty()) first = found;
      EXPECT_EQ(found, first);
    });
  }
}

TEST(ClearanceField, holds_far_from_the_origin_and_for_odd_boxes) {
  Rng rng(2, Purpose::test);
  for (const Box& bounds : {Box{{1e6, -3e6}, {1e6 + 900, -3e6 + 17}}, Box{{-5, -5}, {-4.5, 200}},
                            Box{{0, 0}, {1e-3, 1e-3}}}) {
    Drawn drawn{bounds, {}, {}};
    for (int i = 0; i < 5; ++i) {
      drawn.polygons.push_back(random_star(rng, random_point(rng, bounds), 0.2 * bounds.width()));
    }
    drawn.discs.push_back({bounds.hi, 0.1 * bounds.height()});
    expect_bracket(drawn, 0, rng, 2000);
  }
}

TEST(ClearanceField, without_walls_is_the_distance_to_the_border) {
  Rng rng(3, Purpose::test);
  expect_bracket({}, 0, rng, 1000);
  EXPECT_EQ(Drawn{}.map().field().wall_distance({5, 5}), std::numeric_limits<double>::infinity());
}

TEST(ClearanceField, has_no_answer_outside_the_bounds) {
  const Map map = Drawn{}.map(10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 p : {Vec2{-1e-9, 500}, Vec2{2010, 500}, Vec2{1e300, 500}, Vec2{-1e300, -1e300},
                       Vec2{500, -1}, Vec2{500, 1011}, Vec2{nan, 500}, Vec2{500, nan}}) {
    EXPECT_LT(map.field().lower(p), 0);
    EXPECT_FALSE(map.is_free(p, 0));
  }
  EXPECT_LT(ClearanceField().lower({0, 0}), 0);
}

TEST(ClearanceField, chooses_its_cells_within_limits) {
  EXPECT_NEAR(Drawn{}.map().field().columns() * Drawn{}.map().field().rows(), 260e3, 3e3);
  EXPECT_EQ(Drawn{}.map(50).field().columns(), 41);  // the last one for the border itself
  EXPECT_LE(double(Drawn{}.map(1e-6).field().columns()) * Drawn{}.map(1e-6).field().rows(), 4.4e6);
}

}  // namespace
}  // namespace microswarm
