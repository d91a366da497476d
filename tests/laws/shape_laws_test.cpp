// SPDX-License-Identifier: Apache-2.0
// Laws that every shape of an obstacle keeps; distances, areas and cuttings are those of brute
// force.
#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/area.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/world/obstacles/body_set.hpp"
#include "microswarm/world/obstacles/clip.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"
#include "tests/laws/fields_laws.hpp"

namespace microswarm {
namespace {

struct ShapeCase {
  std::string name;
  Shape shape;
};

void PrintTo(const ShapeCase& c, std::ostream* os) { *os << c.name; }

constexpr std::uint32_t number = 4;

std::vector<Body> bodies_at(const Obstacle& obstacle, double t) {
  std::vector<Body> out;
  append_bodies(obstacle, number, t, out);
  return out;
}

Box box_around(const std::vector<Body>& bodies) {
  Box box;
  for (const Body& b : bodies)
    std::visit(
        [&](const auto& s) {
          const Box one = bounding_box(s);
          box.include(one.lo);
          box.include(one.hi);
        },
        b.shape);
  return box;
}

Vec2 point_in(Rng& rng, const Box& box) {
  const double x = rng.uniform(box.lo.x, box.hi.x);
  return {x, rng.uniform(box.lo.y, box.hi.y)};
}

/// Plain even-odd rule over all rings.
bool is_inside(const Polygon& polygon, Vec2 p) {
  bool inside = false;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    if ((a.y > p.y) == (b.y > p.y)) return;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  });
  return inside;
}
bool is_inside(const Disc& disc, Vec2 p) { return distance(p, disc.centre) < disc.radius; }

/// Distance to points spread over the edges at most `step` apart: too great by step / 2 at most.
double brute_distance(const Polygon& polygon, Vec2 p, double step) {
  if (is_inside(polygon, p)) return 0;
  double least = 1e18;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    const int n = 1 + static_cast<int>(distance(a, b) / step);
    for (int i = 0; i <= n; ++i)
      least = std::min(least, distance(p, a + (static_cast<double>(i) / n) * (b - a)));
  });
  return least;
}
double brute_distance(const Disc& disc, Vec2 p, double) {
  return std::max(0.0, distance(p, disc.centre) - disc.radius);
}

double distance_to(const std::vector<Body>& bodies, Vec2 p) {
  double least = 1e18;
  for (const Body& b : bodies)
    least = std::min(least, std::visit([&](const auto& s) { return distance(p, s); }, b.shape));
  return least;
}

bool any_holds(const std::vector<Body>& bodies, Vec2 p) {
  for (const Body& b : bodies)
    if (std::visit([&](const auto& s) { return is_inside(s, p); }, b.shape)) return true;
  return false;
}

const HarmonicArc swinging{{0, 0}, 150, 0.3, 0.9, 7, 0};

class ShapeLaws : public testing::TestWithParam<ShapeCase> {
 protected:
  const Shape& shape() const { return GetParam().shape; }
  std::vector<Body> at(double t) const { return bodies_at({shape(), swinging}, t); }
  /// Moments of its period at which there is something.
  static constexpr std::array<double, 4> moments{0, 1.7, 4.1, 11.3};
};

TEST_P(ShapeLaws, MakesSense) {
  EXPECT_TRUE(validate(Obstacle{shape(), swinging}).empty());
  bool is_there = false;
  for (const double t : moments)
    for (const Body& body : at(t)) {
      is_there = true;
      EXPECT_EQ(body.obstacle, number);
      if (const auto* disc = std::get_if<Disc>(&body.shape)) {
        EXPECT_TRUE(is_finite(disc->centre));
        EXPECT_GT(disc->radius, 0);
      } else {
        const auto& polygon = std::get<Polygon>(body.shape);
        EXPECT_GT(signed_area(polygon.outer), 0) << "counter-clockwise";
        for (const auto& hole : polygon.holes) EXPECT_LT(signed_area(hole), 0);
        for_each_edge(polygon, [](Vec2 a, Vec2 b) { EXPECT_TRUE(is_finite(a) && !(a == b)); });
      }
    }
  EXPECT_TRUE(is_there);
}

TEST_P(ShapeLaws, PureInTime) {
  const auto digest = [](const std::vector<Body>& bodies) {
    Hash hash;
    for (const Body& b : bodies) {
      if (const auto* disc = std::get_if<Disc>(&b.shape)) {
        hash.value(disc->centre.x);
        hash.value(disc->centre.y);
        hash.value(disc->radius);
      } else {
        for_each_edge(std::get<Polygon>(b.shape), [&](Vec2 v, Vec2) {
          hash.value(v.x);
          hash.value(v.y);
        });
      }
    }
    return hash.hex();
  };
  std::vector<std::string> forwards;
  for (const double t : moments) forwards.push_back(digest(at(t)));
  for (std::size_t i = moments.size(); i-- > 0;) EXPECT_EQ(digest(at(moments[i])), forwards[i]);
}

TEST_P(ShapeLaws, NoPointIsFasterThanItsTopSpeed) {
  const double top = top_speed(Obstacle{shape(), swinging});
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    const double t = rng.uniform(-5, 30);
    const double dt = std::pow(10.0, rng.uniform(-3, 0));
    const auto before = at(t);
    const auto after = at(t + dt);
    if (before.empty() || after.empty()) continue;  // leaves come out of where they rest
    for (int k = 0; k < 5; ++k) {
      const Vec2 p = point_in(rng, {{-600, -400}, {600, 400}});
      ASSERT_LE(distance_to(before, p) - distance_to(after, p), top * dt + 1e-6);
    }
  }
}

TEST_P(ShapeLaws, MovesAsAWholeWithItsMotion) {
  const Pose2 moved{{70, -30}, 0.8};
  Rng rng(2, Purpose::test);
  for (const double t : moments) {
    const auto rest = bodies_at({shape(), Still{}}, t);
    const auto there = bodies_at({shape(), Still{moved.position, moved.heading}}, t);
    ASSERT_EQ(rest.size(), there.size());
    if (rest.empty()) continue;
    const Box around = box_around(rest).grown(50);
    for (int i = 0; i < 100; ++i) {
      const Vec2 p = point_in(rng, around);
      EXPECT_NEAR(distance_to(rest, p),
                  distance_to(there, moved.position + rotated(p, moved.heading)), 1e-6);
    }
  }
}

TEST_P(ShapeLaws, DistanceIsThatOfBruteForce) {
  constexpr double step = 0.5;
  Rng rng(3, Purpose::test);
  for (const double t : moments) {
    const auto bodies = at(t);
    if (bodies.empty()) continue;
    const BodySet set(bodies);
    const Box around = box_around(bodies).grown(60);
    for (int i = 0; i < 40; ++i) {
      const Vec2 p = point_in(rng, around);
      double brute = 1e18;
      for (const Body& b : bodies)
        brute = std::min(
            brute, std::visit([&](const auto& s) { return brute_distance(s, p, step); }, b.shape));
      const double exact = distance_to(bodies, p);
      ASSERT_LE(exact, brute + 1e-9);
      ASSERT_GE(exact, brute - step);
      ASSERT_NEAR(set.clearance(p, 1e9), exact, 1e-9);
      ASSERT_EQ(set.holds(p), any_holds(bodies, p));
      const double r = rng.uniform(0, 60);
      ASSERT_EQ(set.is_free(p, r), exact >= r && exact > 0);
    }
  }
}

TEST_P(ShapeLaws, CoversWhatACountOfPointsCovers) {
  constexpr int across = 160;
  Rng rng(4, Purpose::test);
  for (const double t : moments) {
    const auto bodies = at(t);
    if (bodies.empty()) continue;
    std::vector<const Polygon*> polygons;
    std::vector<Disc> discs;
    for (const Body& b : bodies) {
      if (const auto* polygon = std::get_if<Polygon>(&b.shape)) polygons.push_back(polygon);
      if (const auto* disc = std::get_if<Disc>(&b.shape)) discs.push_back(*disc);
    }
    for (int i = 0; i < 3; ++i) {
      const Disc circle{point_in(rng, box_around(bodies)), rng.uniform(20, 90)};
      const double cell = 2 * circle.radius / across;
      int covered = 0;
      for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column) {
          const Vec2 p = circle.centre + Vec2{(column + 0.5) * cell - circle.radius,
                                              (row + 0.5) * cell - circle.radius};
          covered += is_inside(circle, p) && any_holds(bodies, p);
        }
      const double area_of_circle = area(circle);
      EXPECT_NEAR(covered_area(circle, polygons, discs), covered * cell * cell,
                  0.01 * area_of_circle);
      Survey seen;
      BodySet(bodies).survey(circle, seen);
      EXPECT_NEAR(seen.covered_area, covered * cell * cell, 0.01 * area_of_circle);
      EXPECT_EQ(seen.obstacles, distance_to(bodies, circle.centre) <= circle.radius ? 1 : 0);
    }
  }
}

TEST_P(ShapeLaws, CuttingOutLeavesTheRest) {
  Rng rng(5, Purpose::test);
  for (const double t : moments) {
    std::vector<Polygon> polygons;
    double solid = 0;
    for (const Body& b : at(t))
      if (const auto* polygon = std::get_if<Polygon>(&b.shape)) {
        polygons.push_back(*polygon);
        solid += area(*polygon);
      }
    if (polygons.empty()) continue;
    const auto area_of = [](const std::vector<Polygon>& all) {
      double sum = 0;
      for (const Polygon& p : all) sum += area(p);
      return sum;
    };
    const Box box = box_around(at(t)).grown(20);
    EXPECT_NEAR(area_of(united(polygons)), solid, 1e-6 * solid);
    std::vector<Polygon> twice = polygons;
    twice.insert(twice.end(), polygons.begin(), polygons.end());
    EXPECT_NEAR(area_of(united(twice)), solid, 1e-6 * solid) << "with itself";
    const std::vector<Polygon> rest = difference(box, polygons);
    EXPECT_NEAR(area_of(rest) + solid, box.width() * box.height(), 1e-6 * solid);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p = point_in(rng, box);
      int held = 0;
      for (const Polygon& one : rest) held += is_inside(one, p);
      for (const Polygon& one : polygons) held += is_inside(one, p);
      ASSERT_EQ(held, 1) << p.x << ", " << p.y;
    }
  }
}

TEST_P(ShapeLaws, ReadsBack) { laws::expect_reads_back(shape()); }
TEST_P(ShapeLaws, LimitsAreKept) { EXPECT_GT(laws::expect_limits_are_kept(shape()), 1); }

std::vector<ShapeCase> shape_cases() {
  const DeformingChannel channel{
      .centre_line = {{-800, 200}, {-300, -200}, {300, 200}, {800, -200}},
      .half_width = 150,
      .end_half_width = 200,
      .end_length = 200,
      .amplitude = 30,
      .wavelength = 500,
      .period = 12};
  return {{"Disc", DiscShape{30}},
          {"BreathingDisc", BreathingDisc{20, 90, 6, 0.1}},
          {"Box", BoxShape{120, 30}},
          {"Polygon", PolygonShape{{{0, 0}, {80, 10}, {20, 60}}}},
          {"PolygonClockwise", PolygonShape{{{-40, -40}, {-40, 50}, {10, 0}, {60, 50}, {60, -40}}}},
          {"Valve", Valve{300, 40, 20, 200, 8, 0}},
          {"ValveThatOpensWholly", Valve{200, 30, 0, 300, 8, 0.5}},
          {"DeformingChannel", channel}};
}

INSTANTIATE_TEST_SUITE_P(All, ShapeLaws, testing::ValuesIn(shape_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm
