// SPDX-License-Identifier: Apache-2.0
// Trapezoids: cells, and what is seen from a place, beside brute force.
#include "microswarm/geometry/trapezoid_sight.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

/// Segments that do not cross; many touch, are in a line or vertical.
std::vector<Segment> random_segments(Rng& rng, int kind) {
  std::vector<Segment> all;
  if (kind == 2) return traced_pixels(random_pixels(rng, 8, 0.4), 1, {0, 0});
  for (int i = 0; i < 60; ++i) {
    const Box box{{0, 0}, {12, 12}};
    const Segment s = kind == 0 ? Segment{random_point(rng, box), random_point(rng, box)}
                                : Segment{lattice_point(rng, 13), lattice_point(rng, 13)};
    const bool is_apart = std::ranges::none_of(all, [&](const Segment& o) {
      if (kind == 0) return intersects(s, o);
      // Shared ends and ends on another are allowed.
      const int a = orientation(o.a, o.b, s.a), b = orientation(o.a, o.b, s.b);
      const int c = orientation(s.a, s.b, o.a), d = orientation(s.a, s.b, o.b);
      return (a * b < 0 && c * d < 0) || (a == 0 && b == 0 && intersects(s, o));
    });
    if (is_apart && s.a != s.b) all.push_back(s);
  }
  return all;
}

/// Whether the open segment from a to b meets another segment than at its ends.
bool touches(const std::vector<Segment>& all, Vec2 a, Vec2 b) {
  return std::ranges::any_of(all, [&](const Segment& s) {
    if (s.a == a || s.b == a || s.a == b || s.b == b) return false;
    return intersects(s, {a, b});
  });
}

/// Whether one crosses it properly.
bool crosses(const std::vector<Segment>& all, Vec2 a, Vec2 b) {
  return std::ranges::any_of(all, [&](const Segment& s) {
    return orientation(s.a, s.b, a) * orientation(s.a, s.b, b) < 0 &&
           orientation(a, b, s.a) * orientation(a, b, s.b) < 0;
  });
}

/// Whether a segment from `a` hides everything behind it in the direction of b.
bool runs_along(const std::vector<Segment>& all, Vec2 a, Vec2 b) {
  return std::ranges::any_of(all, [&](const Segment& s) {
    return (s.a == a || s.b == a) && orientation(s.a, s.b, b) == 0;
  });
}

void expect_seen(const Trapezoids& cells, const std::vector<Segment>& all, Vec2 from,
                 const std::multiset<std::uint32_t>& seen) {
  for (std::uint32_t i = 0; i < cells.points().size(); ++i) {
    const Vec2 p = cells.points()[i];
    if (p == from) continue;
    if (!touches(all, from, p) && !runs_along(all, from, p)) {
      EXPECT_TRUE(seen.contains(i)) << from.x << ',' << from.y << " sees " << p.x << ',' << p.y;
    }
    if (seen.contains(i)) {
      EXPECT_FALSE(crosses(all, from, p)) << from.x << ',' << from.y << " to " << p.x << ',' << p.y;
    }
  }
}

TEST(Trapezoids, WhatIsSeenIsWhatBruteForceSees) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 300; ++world) {
    const std::vector<Segment> all = random_segments(rng, world % 3);
    const Trapezoids cells(all);
    std::multiset<std::uint32_t> seen;
    const auto see = [&](std::uint32_t point, Sides) { seen.insert(point); };
    const auto none = [](std::uint32_t, auto&&) {};
    SCOPED_TRACE(::testing::Message() << "kind " << world % 3 << " world " << world);
    for (int i = 0; i < 10; ++i) {
      const Vec2 from = random_point(rng, {{-1, -1}, {13, 13}});
      seen.clear();
      TrapezoidSight(cells).look_around(Rays{from}, see, none);
      expect_seen(cells, all, from, seen);
    }
    for (std::uint32_t from = 0; from < cells.points().size(); ++from) {
      seen.clear();
      TrapezoidSight(cells).look_around(Rays{cells.points()[from]}, see, none);
      expect_seen(cells, all, cells.points()[from], seen);
    }
  }
}

TEST(Trapezoids, StepByStepTheSameIsSeenAndWhatIsNearTheWayFirst) {
  Rng rng(4, Purpose::test);
  const auto none = [](std::uint32_t, auto&&) {};
  int put_off = 0;
  for (int world = 0; world < 300; ++world) {
    SCOPED_TRACE(::testing::Message() << "kind " << world % 3 << " world " << world);
    const Trapezoids cells(random_segments(rng, world % 3));
    TrapezoidLook look;
    for (int i = 0; i < 10; ++i) {
      const bool is_end = i % 2 == 0;
      const Vec2 from = is_end ? cells.points()[rng.below(cells.points().size())]
                               : random_point(rng, {{-1, -1}, {13, 13}});
      const Vec2 to = random_point(rng, {{-1, -1}, {13, 13}});
      std::multiset<std::uint32_t> all, seen;
      TrapezoidSight(cells).look_around(
          Rays{from}, [&](std::uint32_t point, Sides) { all.insert(point); }, none);
      look.begin(cells, from, to, 0);
      double length = distance(from, to);
      for (int step = 0; look.left() < std::numeric_limits<double>::infinity(); ++step) {
        ASSERT_LT(step, 1000);
        look.go_on(
            length, [&](std::uint32_t point, Sides) { seen.insert(point); }, none);
        for (const std::uint32_t point : all) {
          const Vec2 p = cells.points()[point];
          if (distance(from, p) + distance(p, to) < look.left()) {
            EXPECT_EQ(seen.count(point), all.count(point));
          }
        }
        put_off += look.left() < std::numeric_limits<double>::infinity();
        length = 1.02 * std::max(length, look.left());
      }
      EXPECT_EQ(seen, all);
    }
  }
  EXPECT_GT(put_off, 1000);
}

TEST(Trapezoids, ACellHoldsThePlacesBetweenItsSegmentsAndWalls) {
  Rng rng(2, Purpose::test);
  for (int world = 0; world < 300; ++world) {
    const Trapezoids cells(random_segments(rng, world % 3));
    EXPECT_LE(cells.cells().size(), 3 * 200u);
    for (int i = 0; i < 100; ++i) {
      const Vec2 p =
          i % 2 == 0 ? random_point(rng, {{-1, -1}, {13, 13}}) : 0.5 * lattice_point(rng, 26);
      SCOPED_TRACE(::testing::Message()
                   << "kind " << world % 3 << " world " << world << " p " << p.x << " " << p.y);
      const auto& cell = cells.cells()[cells.cell_at(p)];
      const auto side = [&](std::uint32_t s) {
        return orientation(cells.segments()[s].a, cells.segments()[s].b, p);
      };
      if (cell.bottom != Trapezoids::none) {
        EXPECT_GE(side(cell.bottom), 0);
      }
      if (cell.top != Trapezoids::none) {
        EXPECT_LE(side(cell.top), 0);
      }
      if (cell.left != Trapezoids::none) {
        EXPECT_FALSE(is_left_of(p, cells.points()[cell.left]));
      }
      if (cell.right != Trapezoids::none) {
        EXPECT_FALSE(is_left_of(cells.points()[cell.right], p));
      }
    }
  }
}

TEST(Trapezoids, NothingIsSeenWhereNothingIs) {
  const Trapezoids cells(std::vector<Segment>{{{1, 1}, {1, 1}}});
  EXPECT_EQ(cells.cells().size(), 1u);
  EXPECT_EQ(cells.cell_at({3, 4}), 0u);
  EXPECT_EQ(cells.point_at({1, 1}), Trapezoids::none);
  TrapezoidSight(cells).look_around(
      Rays{{0, 0}}, [](std::uint32_t, Sides) { FAIL(); }, [](std::uint32_t, auto&&) {});
}

}  // namespace
}  // namespace microswarm
