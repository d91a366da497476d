// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/predicates.hpp"

#include <gtest/gtest.h>

#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

/// The determinant in integers: coordinates are integers below 2²⁹.
int integer_orientation(Vec2 a, Vec2 b, Vec2 c) {
  using Wide = std::int64_t;
  auto of = [](double x) { return static_cast<Wide>(x); };
  const Wide det =
      (of(a.x) - of(c.x)) * (of(b.y) - of(c.y)) - (of(a.y) - of(c.y)) * (of(b.x) - of(c.x));
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

void expect_laws(Vec2 a, Vec2 b, Vec2 c) {
  const int side = orientation(a, b, c);
  EXPECT_EQ(orientation(b, c, a), side);
  EXPECT_EQ(orientation(c, a, b), side);
  EXPECT_EQ(orientation(b, a, c), -side);
  EXPECT_EQ(orientation(-a, -b, -c), side);
  EXPECT_EQ(exact_orientation(a, b, c), side);
  for (const double scale : {0x1p-300, 0x1p300}) {
    EXPECT_EQ(orientation(scale * a, scale * b, scale * c), side);
  }
}

/// `p` moved by up to two units in the last place of either coordinate.
Vec2 nudged(Rng& rng, Vec2 p) {
  auto nudge = [&](double x) {
    for (std::uint64_t n = rng.below(3); n > 0; --n) x = std::nextafter(x, 1e9);
    for (std::uint64_t n = rng.below(3); n > 0; --n) x = std::nextafter(x, -1e9);
    return x;
  };
  return {nudge(p.x), nudge(p.y)};
}

TEST(Orientation, IntegersAreExact) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t n = i % 2 == 0 ? 4 : 1u << 29;
    const Vec2 a = lattice_point(rng, n);
    const Vec2 b = lattice_point(rng, n);
    const Vec2 c = i % 3 == 0 ? a + double(rng.below(3)) * (b - a) : lattice_point(rng, n);
    EXPECT_EQ(orientation(a, b, c), integer_orientation(a, b, c));
    expect_laws(a, b, c);
  }
}

TEST(Orientation, NearlyCollinearKeepsItsLaws) {
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 a = random_point(rng, {{-1e3, -1e3}, {1e3, 1e3}});
    const Vec2 b = random_point(rng, {{-1e3, -1e3}, {1e3, 1e3}});
    expect_laws(a, b, nudged(rng, a + rng.uniform(-1, 2) * (b - a)));
    expect_laws(a, nudged(rng, a), nudged(rng, a));
  }
}

TEST(Orientation, LastPlacesNextToTheDiagonal) {
  // The classic test of Kettner et al.: a grid of last places around (0.5, 0.5).
  const double ulp = 0x1p-53;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p{0.5 + i * ulp, 0.5 + j * ulp};
      EXPECT_EQ(orientation({12, 12}, {24, 24}, p), (p.y > p.x) - (p.y < p.x));
    }
  }
}

TEST(Orientation, TinyCoordinates) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, least}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, -least}), -1);
  EXPECT_EQ(orientation({0, 0}, {least, 0}, {0, least}), 1);
  EXPECT_EQ(orientation({0, 0}, {least, least}, {2 * least, 2 * least}), 0);
}

TEST(Orientation, BesideIsNeverZeroAndIsTheLimit) {
  Rng rng(3, Purpose::test);
  for (int i = 0; i < 5000; ++i) {
    const Vec2 a = lattice_point(rng, 6);
    const Vec2 b = lattice_point(rng, 6);
    const Vec2 p = lattice_point(rng, 6);
    const int side = orientation_beside(a, b, p);
    EXPECT_EQ(side, a == b ? 0 : orientation(a, b, p + Vec2{0x1p-20, 0x1p-40}));
    EXPECT_EQ(orientation_beside(b, a, p), -side);
  }
}

TEST(Intersects, LatticeAgreesWithTheDefinition) {
  // On a lattice all meetings are found by rational parameters: integers decide exactly.
  Rng rng(4, Purpose::test);
  for (int i = 0; i < 50000; ++i) {
    const Segment s{lattice_point(rng, 5), lattice_point(rng, 5)};
    const Segment t{lattice_point(rng, 5), lattice_point(rng, 5)};
    const Vec2 d = s.b - s.a;
    const Vec2 e = t.b - t.a;
    const Vec2 f = t.a - s.a;
    const double det = cross(d, e);
    bool meet = false;
    if (det != 0) {
      const double u = cross(f, e) * det;
      const double v = cross(f, d) * det;
      meet = u >= 0 && u <= det * det && v >= 0 && v <= det * det;
    } else {
      meet = contains(s, t.a) || contains(s, t.b) || contains(t, s.a) || contains(t, s.b);
    }
    EXPECT_EQ(intersects(s, t), meet);
    EXPECT_EQ(intersects(t, s), meet);
    EXPECT_EQ(intersects({s.b, s.a}, t), meet);
  }
}

TEST(Intersects, LastPlaceDecides) {
  const Segment wall{{0, 0}, {1, 0}};
  EXPECT_TRUE(intersects(wall, {{0.3, 1}, {0.3, 0}}));
  EXPECT_FALSE(intersects(wall, {{0.3, 1}, {0.3, 1e-300}}));
  EXPECT_TRUE(intersects(wall, {{1, 0}, {2, 0}}));
  EXPECT_FALSE(intersects(wall, {{std::nextafter(1, 2), 0}, {2, 0}}));
}

TEST(Locate, CornersEdgesHolesAndTouchingRings) {
  const Polygon polygon{{{0, 0}, {8, 0}, {8, 8}, {4, 8}, {0, 8}},
                        {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}}};
  EXPECT_EQ(locate(polygon, {1, 1}), Side::inside);
  EXPECT_EQ(locate(polygon, {3, 3}), Side::outside);
  EXPECT_EQ(locate(polygon, {5, 5}), Side::outside);
  EXPECT_EQ(locate(polygon, {3, 5}), Side::inside);
  EXPECT_EQ(locate(polygon, {9, 4}), Side::outside);
  EXPECT_EQ(locate(polygon, {-1, 0}), Side::outside);
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
      EXPECT_EQ(locate(polygon, a + t * (b - a)), Side::boundary);
    }
  });
  EXPECT_EQ(locate(Polygon{}, {0, 0}), Side::outside);
}

TEST(Locate, AgreesWithWindingOffTheBoundary) {
  Rng rng(5, Purpose::test);
  for (int i = 0; i < 3000; ++i) {
    const Polygon star{random_star(rng, {0, 0}, 10), {}};
    const Vec2 p = i % 3 == 0 ? nudged(rng, star.outer[rng.below(star.outer.size())])
                              : random_point(rng, {{-10, -1}, {10, 1}});
    int winding = 0;
    int level_way = 0;
    bool on_edge = false;
    for_each_edge(star, [&](Vec2 a, Vec2 b) {
      winding += winding_of_edge(a, b, p);
      level_way += winding_along(a, b, {20, 20}, p);
      on_edge |= contains(Segment{a, b}, p);
    });
    EXPECT_EQ(winding, level_way);
    const Side side = locate(star, p);
    EXPECT_EQ(side == Side::boundary, on_edge);
    if (!on_edge) {
      EXPECT_EQ(side == Side::inside, winding == 1);
    }
  }
}

}  // namespace
}  // namespace microswarm
