// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::formats {
namespace {

using Ring = std::vector<Vec2>;

/// '#' is set; every row has the same length.
Mask mask_of(const std::vector<std::string>& rows) {
  Mask mask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column)
      mask.at(column, row) =
          rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
  return mask;
}

Mask random_mask(int width, int height, double density, Rng& rng) {
  Mask mask(width, height);
  for (auto& cell : mask.cells) cell = rng.uniform() < density;
  return mask;
}

/// Number of pieces of the cells with that value; with corners or with edges only.
int count_pieces(const Mask& mask, std::uint8_t value, bool corners) {
  Mask left = mask;
  int pieces = 0;
  for (int r = 0; r < mask.height; ++r) {
    for (int c = 0; c < mask.width; ++c) {
      if (left.at(c, r) != value) continue;
      ++pieces;
      std::vector<std::pair<int, int>> todo{{c, r}};
      while (!todo.empty()) {
        const auto [x, y] = todo.back();
        todo.pop_back();
        if (x < 0 || y < 0 || x >= mask.width || y >= mask.height || left.at(x, y) != value)
          continue;
        left.at(x, y) = 2;
        for (int dx = -1; dx <= 1; ++dx)
          for (int dy = -1; dy <= 1; ++dy)
            if (corners || dx == 0 || dy == 0) todo.push_back({x + dx, y + dy});
      }
    }
  }
  return pieces;
}

bool inside(Vec2 p, const Ring& ring) {
  bool in = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 a = ring[i], b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

/// How many polygons hold the point.
int covered(Vec2 p, const std::vector<Polygon>& walls) {
  int count = 0;
  for (const Polygon& wall : walls) {
    bool in = inside(p, wall.outer);
    for (const Ring& hole : wall.holes) in = in && !inside(p, hole);
    count += in;
  }
  return count;
}

void expect_axis_parallel_turns(const Ring& ring) {
  ASSERT_GE(ring.size(), 4u);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
    EXPECT_TRUE((a.x == b.x) != (a.y == b.y));
    EXPECT_NE(a.x == b.x, b.x == c.x) << "no turn";
  }
}

TEST(Mask, ThresholdsAreComplements) {
  const Image image{3, 1, 1, {127, 128, 129}};
  EXPECT_EQ(threshold(image, 128, true).cells, (std::vector<std::uint8_t>{1, 0, 0}));
  EXPECT_EQ(threshold(image, 128, false).cells, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(Mask, TopRowIsHighestY) {
  const std::vector<Polygon> walls = mask_walls(mask_of({".#", "..", ".."}), 10);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_TRUE(walls[0].holes.empty());
  const Box box = bounding_box(walls[0]);
  EXPECT_EQ(box.lo, (Vec2{10, 20}));
  EXPECT_EQ(box.hi, (Vec2{20, 30}));
  EXPECT_EQ(area(walls[0]), 100);
  EXPECT_GT(signed_area(walls[0].outer), 0);
}

TEST(Mask, CellCentreAndBoundsAgreeWithWalls) {
  const Mask mask = mask_of({".#", "..", ".."});
  const Vec2 lo{-5, 7};
  EXPECT_EQ(cell_centre(mask, 1, 0, 10, lo), (Vec2{10, 32}));
  EXPECT_EQ(covered(cell_centre(mask, 1, 0, 10, lo), mask_walls(mask, 10, lo)), 1);
  const Box bounds = cell_bounds(mask, 10, lo);
  EXPECT_EQ(bounds.lo, lo);
  EXPECT_EQ(bounds.hi, (Vec2{15, 37}));
}

TEST(Mask, CornersHoldTogether) {
  const std::vector<Polygon> walls = mask_walls(mask_of({"#..", ".#.", "..#"}), 1);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].outer.size(), 12u);
  EXPECT_EQ(area(walls[0]), 3);
}

TEST(Mask, IslandInAHoleIsItsOwnPiece) {
  const std::vector<Polygon> walls =
      mask_walls(mask_of({"#####", "#...#", "#.#.#", "#...#", "#####"}), 2);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_EQ(walls[0].outer, (Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  ASSERT_EQ(walls[0].holes.size(), 1u);
  EXPECT_LT(signed_area(walls[0].holes[0]), 0);
  EXPECT_EQ(area(walls[0]), 64);
  EXPECT_EQ(walls[1].outer.size(), 4u);
  EXPECT_EQ(area(walls[1]), 4);
}

TEST(Mask, FreeCellsThatTouchByACornerAreTwoHoles) {
  const std::vector<Polygon> walls = mask_walls(mask_of({"####", "#.##", "##.#", "####"}), 1);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].holes.size(), 2u);
}

TEST(Mask, NothingAndEverything) {
  EXPECT_TRUE(mask_walls(mask_of({"...", "..."}), 1).empty());
  const std::vector<Polygon> all = mask_walls(mask_of({"###", "###"}), 1);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].outer.size(), 4u);
}

TEST(Mask, RandomMasksKeepTheirCellsPiecesAndHoles) {
  Rng rng(11, Purpose::test);
  for (int trial = 0; trial < 300; ++trial) {
    const Mask mask = random_mask(1 + static_cast<int>(rng.below(14)),
                                  1 + static_cast<int>(rng.below(14)), rng.uniform(), rng);
    const double cell = 0.5;
    const std::vector<Polygon> walls = mask_walls(mask, cell, {3, -2});
    std::size_t holes = 0;
    double sum = 0;
    for (const Polygon& wall : walls) {
      expect_axis_parallel_turns(wall.outer);
      EXPECT_GT(signed_area(wall.outer), 0);
      holes += wall.holes.size();
      sum += area(wall);
      for (const Ring& hole : wall.holes) {
        expect_axis_parallel_turns(hole);
        EXPECT_LT(signed_area(hole), 0);
      }
    }
    EXPECT_DOUBLE_EQ(
        sum,
        cell * cell * static_cast<double>(std::count(mask.cells.begin(), mask.cells.end(), 1)));
    EXPECT_EQ(static_cast<int>(walls.size()), count_pieces(mask, 1, true));
    Mask framed(mask.width + 2, mask.height + 2);
    for (int r = 0; r < mask.height; ++r)
      for (int c = 0; c < mask.width; ++c) {
        framed.at(c + 1, r + 1) = mask.at(c, r);
        EXPECT_EQ(covered(cell_centre(mask, c, r, cell, {3, -2}), walls), mask.at(c, r));
      }
    EXPECT_EQ(static_cast<int>(holes) + 1, count_pieces(framed, 0, false));
  }
}

TEST(Mask, RefusesCellsThatAreNone) {
  const Mask mask = mask_of({"#"});
  EXPECT_THROW(mask_walls(mask, 0), InputError);
  EXPECT_THROW(mask_walls(mask, -1), InputError);
  EXPECT_THROW(mask_walls(mask, std::nan("")), InputError);
  EXPECT_THROW(mask_walls(mask, 1, {INFINITY, 0}), InputError);
}

TEST(Simplify, LeavesOutOnlyWhatIsNear) {
  Rng rng(12, Purpose::test);
  for (const double tolerance : {0.5, 1.0, 3.0}) {
    for (int trial = 0; trial < 30; ++trial) {
      const Mask mask = random_mask(20, 20, 0.7, rng);
      const std::vector<Polygon> exact = mask_walls(mask, 1);
      std::vector<Polygon> simple = exact;
      simplify(simple, tolerance);
      ASSERT_EQ(simple.size(), exact.size());
      for (std::size_t i = 0; i < exact.size(); ++i) {
        ASSERT_EQ(simple[i].holes.size(), exact[i].holes.size());
        ASSERT_GE(simple[i].outer.size(), 3u);
        EXPECT_LE(simple[i].outer.size(), exact[i].outer.size());
        for (const Vec2 p : exact[i].outer) {
          double nearest = INFINITY;
          const Ring& ring = simple[i].outer;
          for (std::size_t k = 0; k < ring.size(); ++k)
            nearest = std::min(nearest, distance(p, Segment{ring[k], ring[(k + 1) % ring.size()]}));
          EXPECT_LE(nearest, tolerance * (1 + 1e-12));
        }
      }
    }
  }
}

TEST(Simplify, ZeroChangesNothing) {
  const std::vector<Polygon> exact = mask_walls(mask_of({"#..", "##.", "###"}), 1);
  std::vector<Polygon> same = exact;
  simplify(same, 0);
  EXPECT_EQ(same[0].outer, exact[0].outer);
  simplify(same, 1);
  EXPECT_LT(same[0].outer.size(), exact[0].outer.size());
}

}  // namespace
}  // namespace microswarm::formats
