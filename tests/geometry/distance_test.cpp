// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/distance.hpp"

#include <gtest/gtest.h>

#include "microswarm/geometry/predicates.hpp"
#include "tests/geometry/frame.hpp"
#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

/// Least of f over [0, 1], a convex function, by ternary search.
template <class F>
double least(F&& f) {
  double lo = 0;
  double hi = 1;
  for (int i = 0; i < 120; ++i) {
    const double a = lo + (hi - lo) / 3;
    const double b = hi - (hi - lo) / 3;
    (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
  }
  return f(0.5 * (lo + hi));
}

Vec2 at(Segment s, double t) { return s.a + t * (s.b - s.a); }

Segment random_segment(Rng& rng) {
  const Box box{{-10, -10}, {10, 10}};
  const Vec2 a = rng.below(2) == 0 ? lattice_point(rng, 8) : random_point(rng, box);
  const Vec2 b = rng.below(2) == 0 ? lattice_point(rng, 8) : random_point(rng, box);
  return {a, rng.below(10) == 0 ? a : b};
}

TEST(Distance, PointToSegmentIsTheLeastOverItsPoints) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 3000; ++i) {
    const Segment s = random_segment(rng);
    const Vec2 p = random_segment(rng).a;
    const double d = distance(p, s);
    EXPECT_NEAR(d, least([&](double t) { return distance(p, at(s, t)); }), 1e-7);
    EXPECT_NEAR(distance(p, nearest_point(p, s)), d, 1e-12);
    EXPECT_NEAR(distance(p, Segment{s.b, s.a}), d, 1e-12);
  }
}

TEST(Distance, SegmentToSegmentIsTheLeastOverItsPoints) {
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 2000; ++i) {
    const Segment s = random_segment(rng);
    const Segment t = random_segment(rng);
    const double d = distance(s, t);
    EXPECT_NEAR(d, least([&](double u) { return distance(at(s, u), t); }), 1e-7);
    EXPECT_EQ(distance(t, s), d);
    EXPECT_EQ(d == 0, intersects(s, t));
  }
}

TEST(Distance, ParallelAndCollinear) {
  EXPECT_EQ(distance(Segment{{0, 0}, {10, 0}}, Segment{{3, 2}, {5, 2}}), 2);
  EXPECT_EQ(distance(Segment{{0, 0}, {1, 0}}, Segment{{4, 0}, {5, 0}}), 3);
  EXPECT_EQ(distance(Segment{{0, 0}, {0, 0}}, Segment{{3, 4}, {3, 4}}), 5);
  EXPECT_EQ(distance(Vec2{1, 1}, Segment{{4, 5}, {4, 5}}), 5);
}

TEST(Distance, PolygonWithHole) {
  EXPECT_EQ(distance(Vec2{5, 5}, frame), 3);
  EXPECT_EQ(distance(Vec2{1, 5}, frame), 0);
  EXPECT_EQ(signed_distance({1.25, 5}, frame), -0.75);
  EXPECT_EQ(signed_distance({2, 5}, frame), 0);
  EXPECT_EQ(distance(Vec2{13, 14}, frame), 5);
  EXPECT_EQ(distance(Segment{{5, 5}, {5, 7}}, frame), 1);
  EXPECT_EQ(distance(Segment{{5, 5}, {5, 9}}, frame), 0);
  EXPECT_EQ(distance(Segment{{1, 1}, {1, 1.5}}, frame), 0);
}

TEST(Distance, Discs) {
  EXPECT_EQ(distance(Vec2{5, 0}, Disc{{0, 0}, 2}), 3);
  EXPECT_EQ(distance(Vec2{1, 0}, Disc{{0, 0}, 2}), 0);
  EXPECT_EQ(distance(Segment{{-9, 5}, {9, 5}}, Disc{{0, 0}, 2}), 3);
}

/// Before the contact the disc is clear, at the contact it touches.
template <class Wall>
void expect_first_contact(Segment s, double r, const Wall& wall) {
  const double t = first_contact(s, r, wall);
  if (t == no_contact) {
    EXPECT_GT(distance(s, wall), r * (1 - 1e-12));
    return;
  }
  ASSERT_GE(t, 0);
  ASSERT_LE(t, 1);
  if (t > 0) {
    EXPECT_NEAR(distance(at(s, t), wall), r, 1e-6);
    EXPECT_GE(distance(Segment{s.a, at(s, t * (1 - 1e-6))}, wall), r - 1e-9);
  } else {
    EXPECT_LE(distance(s.a, wall), r * (1 + 1e-12));
  }
}

TEST(FirstContact, IsTouchingAndFirst) {
  Rng rng(3, Purpose::test);
  for (int i = 0; i < 5000; ++i) {
    const Segment s = random_segment(rng);
    const double r = i % 4 == 0 ? 0 : rng.uniform(0, 3);
    expect_first_contact(s, r, random_segment(rng));
    expect_first_contact(s, r, Disc{random_segment(rng).a, rng.uniform(0, 4)});
    expect_first_contact(s, r, frame);
    expect_first_contact(s, r, Polygon{random_star(rng, random_segment(rng).a, 5), {}});
  }
}

TEST(FirstContact, KnownFractions) {
  const Segment way{{0, 0}, {10, 0}};
  EXPECT_EQ(first_contact(way, 1, Segment{{6, -5}, {6, 5}}), 0.5);
  EXPECT_EQ(first_contact(way, 1, Segment{{6, 0}, {9, 0}}), 0.5);
  EXPECT_EQ(first_contact(way, 1, Disc{{8, 0}, 2}), 0.5);
  EXPECT_EQ(first_contact(way, 0, Segment{{5, -5}, {5, 5}}), 0.5);
  EXPECT_EQ(first_contact(way, 1, Segment{{0, 5}, {10, 5}}), no_contact);
  EXPECT_EQ(first_contact(way, 1, Segment{{5, 1}, {10, 1}}), 0.5);
  EXPECT_EQ(first_contact(way, 1, Segment{{-5, 1}, {10, 1}}), 0);
  EXPECT_EQ(first_contact(way, 1, Disc{{5, 0}, 6}), 0);
  EXPECT_EQ(first_contact({{5, 5}, {5, 5}}, 1, frame), no_contact);
}

}  // namespace
}  // namespace microswarm
