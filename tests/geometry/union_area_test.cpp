// SPDX-License-Identifier: Apache-2.0
// The areas along outlines and by arcs beside the one by slabs.
#include "microswarm/geometry/union_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include "microswarm/geometry/arc_area.hpp"
#include "microswarm/geometry/outline_area.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/slab_area.hpp"
#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

/// Discs and polygons that do not overlap one another, relative to the query disc's centre.
struct Near {
  std::vector<Segment> edges;
  int winding = 0;
  std::vector<Disc> discs;

  void add(std::vector<Vec2> ring, double radius) {
    if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Segment e{ring[j], ring[i]};
      winding += winding_of_edge(e.a, e.b, {});
      if (Box{{-radius, -radius}, {radius, radius}}.overlaps(
              Box{{std::min(e.a.x, e.b.x), std::min(e.a.y, e.b.y)},
                  {std::max(e.a.x, e.b.x), std::max(e.a.y, e.b.y)}}))
        edges.push_back(e);
    }
  }
  std::vector<NearObstacle> obstacles() const {
    std::vector<NearObstacle> out;
    if (!edges.empty() || winding != 0) out.push_back({false, {}, edges, winding});
    for (const Disc& disc : discs) out.push_back({true, disc, {}, 0});
    return out;
  }
};

struct Memory {
  std::array<std::byte, 1 << 16> bytes;
  std::pmr::monotonic_buffer_resource resource{bytes.data(), bytes.size()};
};

/// The area by the lengths of level cuts, within 1e-4 of the query disc's.
double sliced_area(double radius, const Near& near) {
  constexpr int slices = 20000;
  double sum = 0;
  std::vector<std::pair<double, double>> cuts;
  std::vector<double> xs;
  for (int i = 0; i < slices; ++i) {
    const double y = radius * (2 * (i + 0.5) / slices - 1);
    xs.clear();
    cuts.clear();
    for (const Segment& e : near.edges)
      if ((e.a.y <= y) != (e.b.y <= y))
        xs.push_back(e.a.x + (y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x));
    std::sort(xs.begin(), xs.end());
    for (std::size_t k = 1; k < xs.size(); k += 2) cuts.emplace_back(xs[k - 1], xs[k]);
    for (const Disc& disc : near.discs) {
      const double h = y - disc.centre.y;
      const double half = std::sqrt(std::max(0.0, disc.radius * disc.radius - h * h));
      cuts.emplace_back(disc.centre.x - half, disc.centre.x + half);
    }
    std::sort(cuts.begin(), cuts.end());
    const double right = std::sqrt(radius * radius - y * y);
    double reached = -right;
    for (const auto& [from, to] : cuts) {
      sum += std::max(0.0, std::min(to, right) - std::max(from, reached));
      reached = std::max(reached, std::min(to, right));
    }
  }
  return sum * 2 * radius / slices;
}

/// Compares the areas, and counts the query if the one along outlines is left to the slabs. In a
/// few degenerate cases the slabs are wrong, which slices tell.
void expect_same_area(double radius, const Near& near, int& left, double tolerance = 1e-9) {
  Memory memory;
  const auto fast = outline_area(radius, near.edges, near.winding, near.discs, memory.resource);
  const double slow = slab_area(radius, near.obstacles(), memory.resource);
  const double arcs = arc_area(radius, near.edges, near.winding, near.discs, memory.resource);
  const bool is_small = near.discs.size() + near.edges.size() <= 64;
  EXPECT_EQ(union_area(radius, near.obstacles(), memory.resource),
            fast.value_or(is_small ? slow : arcs));
  left += !fast;
  if (std::abs(arcs - slow) > tolerance * radius * radius) {
    EXPECT_GT(tolerance, 1e-9) << arcs << " by arcs beside " << slow;
    EXPECT_NEAR(arcs, sliced_area(radius, near), 1e-3 * radius * radius);
  }
  if (!fast || std::abs(*fast - slow) <= tolerance * radius * radius) return;
  EXPECT_GT(tolerance, 1e-9) << *fast << " beside " << slow;
  EXPECT_NEAR(*fast, sliced_area(radius, near), 1e-3 * radius * radius);
}

Disc random_disc(Rng& rng, double reach, double least, double most) {
  return {{rng.uniform(-reach, reach), rng.uniform(-reach, reach)}, rng.uniform(least, most)};
}

TEST(UnionArea, RandomDiscsAndStars) {
  int left = 0;
  for (std::uint32_t trial = 0; trial < 20000; ++trial) {
    Rng rng(3, Purpose::test, trial);
    const double radius = 100;
    Near near;
    // One star in each cell of a grid, so that they do not overlap.
    const double cell = rng.uniform(30, 200);
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        if (rng.below(2) == 0)
          near.add(random_star(rng, cell * Vec2{i + 0.1, j - 0.2}, 0.49 * cell), radius);
    const std::uint64_t discs = rng.below(12);
    for (std::uint64_t k = 0; k < discs; ++k)
      near.discs.push_back(random_disc(rng, 130, 1, rng.below(4) == 0 ? 150 : 40));
    expect_same_area(radius, near, left);
  }
  EXPECT_LT(left, 400);
}

// Coordinates on a lattice: touching, tangent, concentric and equal discs, circles through corners.
TEST(UnionArea, Degenerate) {
  int left = 0;
  for (std::uint32_t trial = 0; trial < 20000; ++trial) {
    Rng rng(4, Purpose::test, trial);
    Near near;
    for (int i = -4; i < 4; i += 2) {
      for (int j = -4; j < 4; j += 2) {
        if (rng.below(3) != 0) continue;
        const Vec2 lo{1.0 * i, 1.0 * j};
        const double size = 1.0 + static_cast<double>(rng.below(2));
        near.add({lo, lo + Vec2{size, 0}, lo + Vec2{size, size}, lo + Vec2{0, size}}, 5);
      }
    }
    const std::uint64_t discs = rng.below(7);
    for (std::uint64_t k = 0; k < discs; ++k)
      near.discs.push_back(
          {lattice_point(rng, 11) - Vec2{5, 5}, 1.0 + static_cast<double>(rng.below(5))});
    expect_same_area(5, near, left, 1e-7);
  }
  EXPECT_LT(left, 19000);
}

// Shapes moved by about the rounding errors of their places.
TEST(UnionArea, NearlyDegenerate) {
  int left = 0;
  for (std::uint32_t trial = 0; trial < 20000; ++trial) {
    Rng rng(5, Purpose::test, trial);
    const double off = maths::pow(10, rng.uniform(-16, -3));
    const auto shaken = [&](Vec2 p) {
      return p + Vec2{rng.uniform(-off, off), rng.uniform(-off, off)};
    };
    Near near;
    if (rng.below(2) == 0)
      near.add({shaken({-3, -3}), shaken({2, -3}), shaken({2, 1}), shaken({-3, 1})}, 5);
    const std::uint64_t discs = 1 + rng.below(5);
    for (std::uint64_t k = 0; k < discs; ++k)
      near.discs.push_back(
          {shaken(lattice_point(rng, 11) - Vec2{5, 5}), 1.0 + static_cast<double>(rng.below(5))});
    expect_same_area(5, near, left, 1e-6);
  }
}

// More discs than the outline is followed for, dense and sparse, beside edges or not.
TEST(UnionArea, ManyDiscs) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Rng rng(6, Purpose::test, trial);
    const double radius = 100;
    Near near;
    const double cell = rng.uniform(30, 200);
    if (rng.below(2) == 0)
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j)
          near.add(random_star(rng, cell * Vec2{i + 0.1, j - 0.2}, 0.49 * cell), radius);
    const double most = maths::pow(10, rng.uniform(-1, 2));
    const std::uint64_t discs = 65 + rng.below(300);
    for (std::uint64_t k = 0; k < discs; ++k)
      near.discs.push_back(random_disc(rng, 130, 0.01 * most, most));
    near.discs.push_back(near.discs[0]);
    Memory memory;
    const double arcs = arc_area(radius, near.edges, near.winding, near.discs, memory.resource);
    EXPECT_EQ(union_area(radius, near.obstacles(), memory.resource), arcs);
    EXPECT_NEAR(arcs, slab_area(radius, near.obstacles(), memory.resource), 1e-9 * radius * radius);
  }
}

// Discs of a lattice that touch, contain one another and cross in common points.
TEST(UnionArea, ManyOnALattice) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    Rng rng(7, Purpose::test, trial);
    Near near;
    const std::uint64_t discs = 65 + rng.below(100);
    for (std::uint64_t k = 0; k < discs; ++k)
      near.discs.push_back(
          {lattice_point(rng, 41) - Vec2{20, 20}, 1.0 + static_cast<double>(rng.below(3))});
    Memory memory;
    EXPECT_NEAR(union_area(17, near.obstacles(), memory.resource), sliced_area(17, near), 0.05);
  }
}

// All of these cross one another, and none is hidden.
TEST(UnionArea, Stops) {
  Near near;
  for (int k = 0; k < 5000; ++k) near.discs.push_back({90 * unit_vector(wrap(0.0012 * k)), 100});
  const std::atomic<bool> flag = true;
  Memory memory;
  const std::vector<NearObstacle> all = near.obstacles();
  EXPECT_EQ(union_area(250, all, memory.resource, Stop(&flag)), 0);
  EXPECT_EQ(slab_area(250, all, memory.resource, Stop(&flag)), 0);
}

TEST(UnionArea, Known) {
  Memory memory;
  const auto area = [&](const Near& near) {
    return outline_area(10, near.edges, near.winding, near.discs, memory.resource).value();
  };
  Near near;
  EXPECT_EQ(area(near), 0);
  near.discs = {{{3, 0}, 2}};
  EXPECT_NEAR(area(near), 4 * pi, 1e-12);
  near.discs.push_back(near.discs[0]);
  EXPECT_NEAR(area(near), 4 * pi, 1e-12);  // counted once
  near.discs = {{{1, 0}, 2}, {{1, 0.5}, 1}};
  EXPECT_NEAR(area(near), 4 * pi, 1e-12);  // one in the other, both around the origin
  near.add({{-20, 3}, {20, 3}, {20, 30}, {-20, 30}}, 10);
  const double segment = 100 * maths::acos(0.3) - 3 * std::sqrt(91.0);
  EXPECT_NEAR(area(near), segment + 4 * pi, 1e-11);
  near.discs.push_back({{0, 0}, 11});
  EXPECT_NEAR(area(near), 100 * pi, 1e-11);
}

}  // namespace
}  // namespace microswarm
