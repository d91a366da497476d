// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

using Interval = std::pair<double, double>;

/// Parts of the horizontal line at y that lie in the polygon.
void cut(const Polygon& polygon, double y, std::vector<Interval>& out) {
  std::vector<double> xs;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    if ((a.y <= y) != (b.y <= y)) xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  });
  std::sort(xs.begin(), xs.end());
  for (std::size_t i = 1; i < xs.size(); i += 2) out.emplace_back(xs[i - 1], xs[i]);
}

void cut(Disc disc, double y, std::vector<Interval>& out) {
  const double h = y - disc.centre.y;
  if (std::abs(h) >= disc.radius) return;
  const double half = std::sqrt(disc.radius * disc.radius - h * h);
  out.emplace_back(disc.centre.x - half, disc.centre.x + half);
}

/// The covered area by summing the lengths of many level cuts.
double sliced_area(Disc disc, const std::vector<Polygon>& polygons,
                   const std::vector<Disc>& discs) {
  constexpr int slices = 4000;
  double sum = 0;
  std::vector<Interval> cuts;
  for (int i = 0; i < slices; ++i) {
    const double y = disc.centre.y + disc.radius * (2 * (i + 0.5) / slices - 1);
    cuts.clear();
    cut(disc, y, cuts);
    const auto [left, right] = cuts[0];
    cuts.clear();
    for (const Polygon& polygon : polygons) cut(polygon, y, cuts);
    for (const Disc& other : discs) cut(other, y, cuts);
    std::sort(cuts.begin(), cuts.end());
    double reached = left;
    for (const auto& [from, to] : cuts) {
      sum += std::max(0.0, std::min(to, right) - std::max(from, reached));
      reached = std::max(reached, std::min(to, right));
    }
  }
  return sum * 2 * disc.radius / slices;
}

double covered(Disc disc, const std::vector<Polygon>& polygons, const std::vector<Disc>& discs) {
  std::vector<const Polygon*> pointers;
  for (const Polygon& polygon : polygons) pointers.push_back(&polygon);
  return covered_area(disc, pointers, discs);
}

EdgeGrid grid_of(const std::vector<Polygon>& polygons) {
  const auto edges = edges_of(polygons);
  return {edges, std::vector<std::uint32_t>(edges.size(), 0)};
}

Polygon box(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
}

Polygon moved(Polygon polygon, Vec2 by, double scale = 1) {
  auto move = [&](std::vector<Vec2>& ring) {
    for (Vec2& v : ring) v = scale * v + by;
  };
  move(polygon.outer);
  for (auto& hole : polygon.holes) move(hole);
  return polygon;
}

TEST(Area, DiscInBoxAndBoxInDisc) {
  const double whole = area(Disc{{}, 2});
  EXPECT_NEAR(intersection_area({{5, 5}, 2}, box(0, 0, 10, 10)), whole, 1e-12);
  EXPECT_NEAR(intersection_area({{5, 5}, 20}, box(4, 4, 2, 3)), 6, 1e-10);
  EXPECT_EQ(intersection_area({{50, 5}, 2}, box(0, 0, 10, 10)), 0);
  EXPECT_EQ(intersection_area(Disc{{0, 0}, 1}, Disc{{3, 0}, 1}), 0);
  EXPECT_EQ(intersection_area(Disc{{0, 0}, 1}, Disc{{0.5, 0}, 4}), area(Disc{{}, 1}));
}

TEST(Area, CentreOnEdgeCornerAndReflexCorner) {
  const double whole = area(Disc{{}, 2});
  const Polygon square = box(0, 0, 10, 10);
  const Polygon notched{{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}, {}};
  for (const Vec2 p : {Vec2{0, 5}, Vec2{5, 0}, Vec2{10, 5}, Vec2{5, 10}}) {
    EXPECT_NEAR(intersection_area({p, 2}, square), whole / 2, 1e-12);
    EXPECT_NEAR(covered_area({p, 2}, grid_of({square})), whole / 2, 1e-12);
    EXPECT_NEAR(covered({p, 2}, {square, moved(square, {-10, 0})}, {}),
                p.x == 0 ? whole : whole / 2, 1e-12);
  }
  for (const Vec2 p : {Vec2{0, 0}, Vec2{10, 0}, Vec2{10, 10}, Vec2{0, 10}}) {
    EXPECT_NEAR(intersection_area({p, 2}, square), whole / 4, 1e-12);
    EXPECT_NEAR(covered_area({p, 2}, grid_of({square})), whole / 4, 1e-12);
    EXPECT_NEAR(covered({p, 2}, {square, square}, {}), whole / 4, 1e-12);
  }
  EXPECT_NEAR(intersection_area({{5, 5}, 2}, notched), 0.75 * whole, 1e-12);
  EXPECT_NEAR(covered_area({{5, 5}, 2}, grid_of({notched})), 0.75 * whole, 1e-12);
}

TEST(Area, CentreAtRandomCornersAndOnDiagonals) {
  Rng rng(11, Purpose::test);
  for (int i = 0; i < 2000; ++i) {
    const Polygon star{random_star(rng, {3, 4}, 10), {}};
    const std::size_t k = rng.below(star.outer.size());
    const Vec2 a = star.outer[k];
    const Vec2 b = star.outer[(k + 1) % star.outer.size()];
    const Vec2 p = i % 2 == 0 ? a : 0.5 * (a + b);
    const double r = rng.uniform(0.1, 15);
    const double at = intersection_area({p, r}, star);
    const double beside = intersection_area({p + Vec2{1e-9, -2e-9}, r}, star);
    EXPECT_NEAR(at, beside, 1e-7 * r);
    EXPECT_NEAR(covered({p, r}, {star}, {}), at, 1e-13 * r * r);
    EXPECT_NEAR(covered({p, r}, {star, star}, {}), at, 1e-12 * r * r);
    EXPECT_NEAR(covered_area({p, r}, grid_of({star})), at, 1e-13 * r * r);
  }
}

TEST(Area, LensOfTwoUnitDiscs) {
  const double expected = 2 * std::acos(0.5) - std::sqrt(3.0) / 2;
  EXPECT_NEAR(intersection_area(Disc{{0, 0}, 1}, Disc{{1, 0}, 1}), expected, 1e-14);
}

TEST(Area, PolygonAndComplementFillTheDisc) {
  Rng rng(12, Purpose::test);
  for (int i = 0; i < 2000; ++i) {
    const Polygon star{random_star(rng, {5, 5}, rng.uniform(1, 40)), {}};
    Polygon rest = box(-100, -100, 210, 210);
    rest.holes.emplace_back(star.outer.rbegin(), star.outer.rend());
    const Disc disc{random_point(rng, {{-30, -30}, {30, 30}}), rng.uniform(0.01, 60)};
    const double inside = intersection_area(disc, star);
    EXPECT_NEAR(inside + intersection_area(disc, rest), area(disc), 1e-13 * area(disc));
    EXPECT_NEAR(covered(disc, {star, rest}, {}), area(disc), 1e-12 * area(disc));
    EXPECT_NEAR(covered_area(disc, grid_of({rest})), area(disc) - inside, 1e-13 * area(disc));
  }
}

TEST(Area, MovesAndScales) {
  Rng rng(13, Purpose::test);
  for (int i = 0; i < 500; ++i) {
    const std::vector<Polygon> stars{{random_star(rng, {5, 5}, 10), {}},
                                     {random_star(rng, {9, 5}, 10), {}}};
    const std::vector<Disc> discs{{{2, 2}, 3}, {{4, 2}, 3}};
    const Disc disc{random_point(rng, {{0, 0}, {10, 10}}), rng.uniform(1, 12)};
    const double plain = covered(disc, stars, discs);
    const Vec2 by{1000, -300};
    const double scale = std::pow(10.0, rng.uniform(-3, 3));
    std::vector<Polygon> stars_moved;
    std::vector<Disc> discs_moved;
    for (const Polygon& star : stars) stars_moved.push_back(moved(star, by, scale));
    for (const Disc& d : discs) discs_moved.push_back({scale * d.centre + by, scale * d.radius});
    const double there =
        covered({scale * disc.centre + by, scale * disc.radius}, stars_moved, discs_moved);
    const double loss = 1e-12 * (1 + 1000 / scale);
    EXPECT_NEAR(there / (scale * scale), plain, 100 * loss * area(disc));
  }
}

TEST(Area, RandomObstaclesAgreeWithSlices) {
  Rng rng(14, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    std::vector<Polygon> polygons;
    std::vector<Disc> discs;
    for (std::uint64_t n = rng.below(5); n > 0; --n) {
      polygons.push_back(
          {random_star(rng, random_point(rng, {{0, 0}, {100, 100}}), rng.uniform(5, 60)), {}});
    }
    for (std::uint64_t n = rng.below(5); n > 0; --n) {
      discs.push_back({random_point(rng, {{0, 0}, {100, 100}}), rng.uniform(1, 30)});
    }
    const Disc disc{random_point(rng, {{0, 0}, {100, 100}}), rng.uniform(5, 80)};
    EXPECT_NEAR(covered(disc, polygons, discs), sliced_area(disc, polygons, discs),
                2e-4 * area(disc));
  }
}

TEST(Area, AlignedOverlappingBoxesCountOnce) {
  Rng rng(15, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    std::vector<Polygon> boxes;
    for (int n = 0; n < 6; ++n) {
      const Vec2 p = lattice_point(rng, 8);
      boxes.push_back(box(p.x, p.y, 1.0 + double(rng.below(4)), 1.0 + double(rng.below(4))));
    }
    const Disc disc{lattice_point(rng, 10), 1.0 + double(rng.below(5))};
    EXPECT_NEAR(covered(disc, boxes, {}), sliced_area(disc, boxes, {}), 1e-3 * area(disc));
    const Disc all{{5, 5}, 100};
    std::set<std::pair<int, int>> cells;
    for (const Polygon& b : boxes) {
      for (int x = int(b.outer[0].x); x < int(b.outer[2].x); ++x) {
        for (int y = int(b.outer[0].y); y < int(b.outer[2].y); ++y) cells.emplace(x, y);
      }
    }
    EXPECT_NEAR(covered(all, boxes, {}), double(cells.size()), 1e-9);
  }
}

TEST(Area, TracedPixelsByTheGridAndAsBoxes) {
  Rng rng(16, Purpose::test);
  for (int i = 0; i < 200; ++i) {
    auto dark = random_pixels(rng, 8, rng.uniform());
    dark.emplace(3, 3);
    const auto edges = traced_pixels(dark, 1, {});
    const EdgeGrid grid(edges, std::vector<std::uint32_t>(edges.size(), 0));
    const Disc disc{i % 2 == 0 ? lattice_point(rng, 9) : random_point(rng, {{0, 0}, {8, 8}}),
                    rng.uniform(0.3, 6)};
    double sum = 0;
    std::vector<Polygon> boxes;
    for (const auto& [x, y] : dark) {
      boxes.push_back(box(x, y, 1, 1));
      sum += intersection_area(disc, boxes.back());
    }
    EXPECT_NEAR(covered_area(disc, grid), sum, 1e-12 * area(disc));
    EXPECT_NEAR(covered(disc, boxes, {}), sum, 1e-12 * area(disc));
  }
}

TEST(Area, ManyDiscsUnionIsInclusionExclusion) {
  Rng rng(17, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const Disc a{random_point(rng, {{0, 0}, {4, 4}}), rng.uniform(0.1, 3)};
    const Disc b{random_point(rng, {{0, 0}, {4, 4}}), rng.uniform(0.1, 3)};
    const Disc all{{2, 2}, 20};
    EXPECT_NEAR(covered(all, {}, {a, b}), area(a) + area(b) - intersection_area(a, b), 1e-11);
    EXPECT_NEAR(covered(a, {}, {b}), intersection_area(a, b), 1e-12);
    EXPECT_NEAR(covered(a, {}, {b, b}), intersection_area(a, b), 1e-12);
  }
}

}  // namespace
}  // namespace microswarm
