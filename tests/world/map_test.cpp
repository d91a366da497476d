// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/map.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "tests/cases.hpp"
#include "tests/each_target.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

Segment random_segment(Rng& rng, const Box& box, int kind) {
  const Vec2 a = random_point(rng, box);
  const double length = kind % 3 == 0 ? 600 : kind % 3 == 1 ? 40 : 3;
  return {a, a + rng.uniform() * length * unit_vector(rng.uniform(-pi, pi))};
}

double random_radius(Rng& rng, int kind) {
  return kind % 4 == 0 ? 0 : kind % 4 == 1 ? 40 : std::pow(10.0, rng.uniform(-3, 2));
}

TEST(Map, answers_as_brute_force_where_nothing_is_united) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 10; ++world) {
    const Drawn drawn = orchard(rng, 5 + world, 3 + world % 4);
    const Map map = drawn.map(world % 2 == 0 ? 0 : 30);
    ASSERT_EQ(map.walls().bodies().size(), drawn.polygons.size() + drawn.discs.size());
    for (int i = 0; i < 10000; ++i) {
      const double r = random_radius(rng, i);
      const Segment s = random_segment(rng, drawn.bounds.grown(5), i);
      const double c = drawn.clearance(s.a);
      ASSERT_EQ(map.clearance(s.a), c);
      ASSERT_EQ(map.is_free(s.a, r), is_free_at(c, r));
      const double along = drawn.clearance(s);
      ASSERT_EQ(map.clearance(s, 1e9), along);
      if (std::abs(along - r) > 1e-9 * (1 + r) || r == 0) {
        ASSERT_EQ(map.is_free(s, r), is_free_at(along, r)) << along << " beside " << r;
      }
    }
  }
}

TEST(Map, answers_as_brute_force_in_a_crowd) {
  Rng rng(2, Purpose::test);
  for (int world = 0; world < 8; ++world) {
    const Drawn drawn = crowded(rng, 5 + 20 * world, 6 * world);
    const Map map = drawn.map();
    for (int i = 0; i < test::cases(5000); ++i) {
      const double r = random_radius(rng, i);
      const Segment s = random_segment(rng, drawn.bounds.grown(5), i);
      const double at = drawn.clearance(s.a);
      EXPECT_NEAR(map.clearance(s.a), at, 1e-8);
      if (std::abs(at - r) > 1e-8) {
        EXPECT_EQ(map.is_free(s.a, r), is_free_at(at, r));
      }
      const double along = drawn.clearance(s);
      EXPECT_NEAR(map.clearance(s, 1e9), along, 1e-8);
      if (std::abs(along - r) > 1e-8) {
        EXPECT_EQ(map.is_free(s, r), is_free_at(along, r));
      }
    }
  }
}

/// Places everywhere, near walls, on borders of cells and beside them, outside, and no numbers.
std::vector<Vec2> places_of_every_kind(Rng& rng, const Drawn& drawn, const Map& map) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Vec2> positions{{nan, 500},  {500, nan}, {nan, nan},      {inf, 500},
                              {500, -inf}, {1e300, 1}, drawn.bounds.lo, drawn.bounds.hi};
  const double cell = map.field().cell();
  const Vec2 origin = drawn.bounds.lo - Vec2{cell, cell};
  const auto beside = [&](double x) {
    const double steps[] = {x, std::nextafter(x, inf), std::nextafter(x, -inf)};
    return steps[rng.below(3)];
  };
  while (positions.size() < 5000) {
    const Vec2 p = random_point(rng, drawn.bounds.grown(20));
    positions.push_back(p);
    const Vec2 cells = (p - origin) / cell;
    positions.push_back({beside(origin.x + std::round(cells.x) * cell),
                         beside(origin.y + std::round(cells.y) * cell)});
    positions.push_back({beside(positions.back().x), p.y});
  }
  return positions;
}

TEST(Map, says_of_many_places_what_it_says_of_each) {
  Rng rng(5, Purpose::test);
  for (int world = 0; world < 6; ++world) {
    const Drawn drawn = world == 0 ? Drawn{} : crowded(rng, 12 * world, 6 * world);
    const Map map = drawn.map(world % 2 == 0 ? 0 : 30);
    const std::vector<Vec2> positions = places_of_every_kind(rng, drawn, map);
    for (const double r : {0.0, 1e-3, 7.0, 40.0, 1e4, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
      std::vector<std::uint8_t> expected;
      for (const Vec2 p : positions) expected.push_back(map.is_free(p, r));
      test::for_each_target([&](const char* target) {
        SCOPED_TRACE(target);
        std::vector<std::uint8_t> found(positions.size(), 7);
        map.are_free(positions, r, found);
        EXPECT_EQ(found, expected);
      });
    }
    for (std::size_t count = 0; count < 40; ++count) {
      std::vector<std::uint8_t> found(count + 1, 7);
      map.are_free(std::span(positions).subspan(20, count), 10, std::span(found).first(count));
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_EQ(found[i], map.is_free(positions[20 + i], 10)) << i << " of " << count;
      EXPECT_EQ(found[count], 7);
    }
  }
  std::vector<std::uint8_t> found(2, 7);
  Map().are_free(std::vector<Vec2>{{0, 0}, {1, 1}}, 0, found);
  EXPECT_EQ(found, (std::vector<std::uint8_t>{0, 0}));
}

TEST(Map, excludes_no_free_place_of_many) {
  Rng rng(6, Purpose::test);
  for (int world = 0; world < 4; ++world) {
    const Drawn drawn = world == 0 ? Drawn{} : crowded(rng, 12 * world, 6 * world);
    const Map map = drawn.map(world % 2 == 0 ? 0 : 30);
    const std::vector<Vec2> positions = places_of_every_kind(rng, drawn, map);
    for (const double r : {0.0, 7.0, 40.0, 1e4, std::numeric_limits<double>::quiet_NaN()}) {
      for (std::size_t i = 0; i + 4 <= positions.size(); i += 4) {
        const unsigned bits = map.may_be_free(std::span(positions).subspan(i, 4), r);
        ASSERT_LT(bits, 16u);
        for (std::size_t k = 0; k < 4; ++k)
          ASSERT_TRUE((bits >> k) % 2 == 1 || !map.is_free(positions[i + k], r));
      }
    }
  }
}

TEST(Map, tells_a_capsule_that_just_passes_from_one_that_just_does_not) {
  Rng rng(7, Purpose::test);
  for (int world = 0; world < 6; ++world) {
    const Drawn drawn = orchard(rng, 5 + world, 3 + world % 4);
    const Map map = drawn.map(world % 2 == 0 ? 0 : 30);
    for (int i = 0; i < 3000; ++i) {
      const Segment s = random_segment(rng, drawn.bounds, i);
      const double along = drawn.clearance(s);
      for (const double by : {1e-10, 1e-8, 1e-6, 1e-4}) {
        if (along <= by) continue;
        ASSERT_TRUE(map.is_free(s, along - by)) << along << " less " << by;
        ASSERT_FALSE(map.is_free(s, along + by)) << along << " and " << by;
      }
    }
  }
}

TEST(Map, never_steps_over_a_thin_wall) {
  Rng rng(3, Purpose::test);
  for (const double thickness : {1.0, 0.01, 1e-6}) {
    Drawn drawn;
    drawn.polygons = {rectangle(1000, 100, 1000 + thickness, 900)};
    const Map map = drawn.map();
    for (int i = 0; i < 20000; ++i) {
      const Segment s{{rng.uniform(1, 999), rng.uniform(101, 899)},
                      {rng.uniform(1002, 1999), rng.uniform(101, 899)}};
      ASSERT_FALSE(map.is_free(s, 0));
      ASSERT_FALSE(map.is_free(Segment{s.b, s.a}, 10 * rng.uniform()));
    }
    EXPECT_TRUE(map.is_free(Segment{{500, 950}, {1500, 950}}, 49));
    EXPECT_TRUE(map.is_free(Segment{{500, 950}, {1500, 950}}, 50));
    EXPECT_FALSE(map.is_free(Segment{{500, 950}, {1500, 950}}, 50.0001));
  }
}

TEST(Map, a_wall_or_the_border_that_is_touched_is_not_free) {
  Drawn drawn;
  drawn.polygons = {rectangle(500, 500, 600, 600)};
  drawn.discs = {{{1000, 500}, 100}};
  const Map map = drawn.map();
  for (const Vec2 p :
       {Vec2{500, 550}, Vec2{600, 600}, Vec2{1100, 500}, Vec2{0, 10}, Vec2{700, 1000}}) {
    EXPECT_EQ(map.clearance(p), 0);
    EXPECT_FALSE(map.is_free(p, 0));
    EXPECT_FALSE(map.is_free(Segment{p, {250, 250}}, 0));
  }
  EXPECT_TRUE(map.is_free(Vec2{499, 550}, 1));
  EXPECT_FALSE(map.is_free(Vec2{499, 550}, std::nextafter(1, 2)));
  EXPECT_TRUE(map.is_free(Vec2{1101, 500}, 1));
  EXPECT_TRUE(map.is_free(Vec2{40, 40}, 40));
  EXPECT_FALSE(map.is_free(Vec2{39.999, 40}, 40));
  EXPECT_TRUE(map.is_free(Segment{{40, 40}, {40, 960}}, 40));
  EXPECT_FALSE(map.is_free(Segment{{40, 40}, {40, 960.001}}, 40));
  EXPECT_TRUE(map.is_free(Vec2{1e-12, 40}, 0));
}

TEST(Map, refuses_what_is_not_a_map) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Box good{{0, 0}, {10, 10}};
  EXPECT_THROW(Map(Box{}, {}), InputError);
  EXPECT_THROW(Map(Box{{0, 0}, {0, 10}}, {}), InputError);
  EXPECT_THROW(Map(Box{{0, 0}, {nan, 10}}, {}), InputError);
  EXPECT_THROW(Map(Box{{-1e308, 0}, {1.5e308, 10}}, {}), InputError);
  EXPECT_THROW(Map(good, {{{{1, 1}, {2, nan}, {3, 3}}, {}}}), InputError);
  EXPECT_THROW(Map(good, {{{{1, 1}, {2, 1}, {3, 3}}, {{{nan, 0}, {1, 1}, {0, 1}}}}}), InputError);
  EXPECT_THROW(Map(good, {}, {{{1, 1}, -1}}), InputError);
  EXPECT_THROW(Map(good, {}, {{{1, 1}, nan}}), InputError);
  try {
    Map(Box{{0, 0}, {0, 10}}, {});
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "map: bounds (0, 0) to (0, 10) µm are empty");
  }
  EXPECT_EQ(Map(good, {Polygon{}, {{{1, 1}, {2, 2}}, {}}}).pieces(), 0);
}

TEST(Map, that_is_empty_or_all_wall_answers) {
  EXPECT_FALSE(Map().is_free(Vec2{0, 0}, 0));
  EXPECT_FALSE(Map().is_free(Segment{{0, 0}, {1, 1}}, 0));
  Drawn drawn;
  drawn.polygons = {rectangle(-10, -10, 2010, 1010)};
  const Map map = drawn.map();
  EXPECT_FALSE(map.is_free(Vec2{1000, 500}, 0));
  EXPECT_FALSE(map.is_free(Segment{{1000, 500}, {1000, 501}}, 0));
  EXPECT_EQ(map.clearance(Vec2{1000, 500}), 0);
}

}  // namespace
}  // namespace microswarm
