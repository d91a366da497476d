// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/corner_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

/// Walls of single cells, one of three at random, `pitch` apart from `origin` on [µm].
std::vector<Polygon> raster(Vec2 origin, double pitch, int side) {
  Rng rng(1, Purpose::scene);
  std::vector<Polygon> walls;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (rng.uniform() > 0.3) continue;
      walls.push_back(rectangle(origin.x + pitch * i, origin.y + pitch * j,
                                origin.x + pitch * (i + 1), origin.y + pitch * (j + 1)));
    }
  return walls;
}

Map with_walls(std::vector<Polygon> walls) {
  return Map({{-1000, -1000}, {4000, 4000}}, std::move(walls));
}

double off(double length, double pitch) { return std::abs(std::remainder(length, pitch)); }

TEST(CornerLattice, OfARasterIsFoundWhateverItsOrigin) {
  for (const Vec2 origin : {Vec2{0, 0}, Vec2{-123.4567, 77.1}, Vec2{1.0 / 3, -500}})
    for (const double pitch : {100.0, 33.333, 50.0 / 3}) {
      const auto found = corner_lattice(with_walls(raster(origin, pitch, 40)), 5);
      ASSERT_TRUE(found) << pitch;
      EXPECT_NEAR(found->pitch, pitch, 1e-6 * pitch);
      EXPECT_LT(off(found->origin.x - origin.x, pitch), 1e-3);
      EXPECT_LT(off(found->origin.y - origin.y, pitch), 1e-3);
    }
}

TEST(CornerLattice, ToleratesRoundedCornersAndAFewElsewhere) {
  std::vector<Polygon> walls = raster({-123.4567, 77.1}, 33.3333, 40);
  for (Polygon& wall : walls)
    for (Vec2& corner : wall.outer)
      corner = {std::round(1e3 * corner.x) / 1e3, std::round(1e3 * corner.y) / 1e3};
  walls.push_back({{{2000.3, 2100.7}, {2111.1, 2122.9}, {2051.7, 2199.1}}, {}});
  const auto found = corner_lattice(with_walls(std::move(walls)), 5);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pitch, 33.3333, 1e-4);
}

TEST(CornerLattice, OfAFineRasterIsNotFoundIfItShouldBeCoarser) {
  EXPECT_FALSE(corner_lattice(with_walls(raster({0, 0}, 20, 40)), 25));
}

TEST(CornerLattice, IsNotFoundAmongFreePolygons) {
  Rng rng(2, Purpose::scene);
  for (const int count : {1, 2, 5, 50}) {
    std::vector<Polygon> walls;
    for (int i = 0; i < count; ++i) {
      const Vec2 at = uniform_in({{0, 0}, {3000, 3000}}, rng);
      walls.push_back({{at, at + Vec2{90.7 + i, 13.3}, at + Vec2{31.9, 77.7 + i}}, {}});
    }
    EXPECT_FALSE(corner_lattice(with_walls(std::move(walls)), 10)) << count;
  }
  EXPECT_FALSE(corner_lattice(with_walls({}), 10));
}

/// A wall across the map with a door of so many cells of 100 µm at x = 1000 µm.
Map door(int cells) {
  return with_walls(
      {rectangle(-1000, 500, 1000, 600), rectangle(1000 + 100.0 * cells, 500, 4000, 600)});
}

TEST(CornerLattice, LeadsThroughTheMiddleOfTheNarrowestDoorThatFits) {
  for (const double clearance : {10.0, 40.0, 50.0, 60.0, 99.0, 120.0}) {
    const int cells = static_cast<int>(std::ceil(clearance / 50));
    const Map map = door(cells);
    const auto positions =
        through_narrowest_passage({.origin = {1000, 500}, .pitch = 100}, clearance);
    EXPECT_EQ(off(positions.origin.x - (1000 + 50.0 * cells), 100), 0) << clearance;
    EXPECT_EQ(shortest_free_run(map, positions, clearance - 1e-9, 100), 1) << clearance;
  }
}

TEST(CornerLattice, TheShortestRunIsTheNarrowestDoor) {
  const CornerLattice positions{.origin = {50, 50}, .pitch = 100};
  EXPECT_EQ(shortest_free_run(door(7), positions, 40, 100), 7);
  EXPECT_EQ(shortest_free_run(door(7), positions, 60, 100), 5);
  EXPECT_EQ(shortest_free_run(door(7), positions, 40, 3), 3);
}

}  // namespace
}  // namespace microswarm
