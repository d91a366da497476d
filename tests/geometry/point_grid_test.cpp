// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/point_grid.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/geometry/random_shapes.hpp"

namespace microswarm {
namespace {

std::uint32_t brute_nearest(const PointGrid& grid, Vec2 p) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < grid.size(); ++i) {
    if (squared_norm(grid[i] - p) < squared_norm(grid[best] - p)) best = i;
  }
  return best;
}

void expect_same_as_brute_force(const std::function<Vec2(Rng&)>& source, const Box& box,
                                std::size_t count) {
  Rng rng(1, Purpose::test);
  PointGrid grid(box);
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < count; ++i) {
    grid.add(source(rng));
    if (i > 40 && i % 37 != 0) continue;
    for (const Vec2 p : {source(rng), random_point(rng, box.grown(50)),
                         grid[rng.below(grid.size())], Vec2{1e7, -1e5}}) {
      ASSERT_EQ(grid.nearest(p), brute_nearest(grid, p));
      const double radius = rng.below(4) == 0 ? norm(grid[rng.below(grid.size())] - p)
                                              : std::pow(10.0, rng.uniform(-3, 3));
      found = {42};
      grid.within(p, radius, found);
      std::vector<std::uint32_t> expected{42};
      for (std::uint32_t k = 0; k < grid.size(); ++k) {
        if (squared_norm(grid[k] - p) <= radius * radius) expected.push_back(k);
      }
      ASSERT_EQ(found, expected);
    }
  }
}

constexpr Box map{{0, 0}, {2000, 1000}};

TEST(PointGrid, UniformPoints) {
  expect_same_as_brute_force([](Rng& rng) { return random_point(rng, map); }, map, 5000);
}

TEST(PointGrid, ClusterInACorner) {
  expect_same_as_brute_force(
      [](Rng& rng) {
        return rng.below(50) == 0 ? random_point(rng, map) : random_point(rng, {{0, 0}, {1, 1e-3}});
      },
      map, 5000);
}

TEST(PointGrid, ScalesOverManyMagnitudes) {
  expect_same_as_brute_force(
      [](Rng& rng) {
        const double scale = std::pow(10.0, rng.uniform(-9, 3));
        return Vec2{500, 500} + scale * random_point(rng, {{-1, -1}, {1, 1}});
      },
      map, 4000);
}

TEST(PointGrid, PointsOutsideTheBox) {
  expect_same_as_brute_force(
      [](Rng& rng) {
        return random_point(rng, {{-1e5, 3000}, {-9e4, 3010}});
      },
      map, 3000);
}

TEST(PointGrid, LatticeWithTiesAndRepeats) {
  expect_same_as_brute_force([](Rng& rng) { return lattice_point(rng, 12); }, {{0, 0}, {12, 12}},
                             4000);
}

TEST(PointGrid, EqualPointsAndALine) {
  expect_same_as_brute_force([](Rng&) { return Vec2{7, 7}; }, map, 500);
  expect_same_as_brute_force([](Rng& rng) { return Vec2{rng.uniform(0, 2000), 3}; }, map, 2000);
}

TEST(PointGrid, EmptyBoxIsOnlyAHint) {
  expect_same_as_brute_force([](Rng& rng) { return lattice_point(rng, 100); }, Box{{3, 3}, {3, 3}},
                             1000);
  PointGrid grid{Box{}};
  grid.add({1, 2});
  grid.add({-4, 8});
  EXPECT_EQ(grid.nearest({-5, 5}), 1u);
}

TEST(PointGrid, ClearForgets) {
  PointGrid grid(map);
  for (int i = 0; i < 1000; ++i) grid.add({double(i), 0});
  grid.clear();
  EXPECT_TRUE(grid.empty());
  grid.add({5, 5});
  EXPECT_EQ(grid.nearest({100, 0}), 0u);
  std::vector<std::uint32_t> found;
  grid.within({5, 5}, 0, found);
  EXPECT_EQ(found, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace microswarm
