// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/uniform_grid.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm {
namespace {

const Box room{{-30, 10}, {70, 60}};

Vec2 random_point(Rng& rng, double beyond) {
  return {rng.uniform(room.lo.x - beyond, room.hi.x + beyond),
          rng.uniform(room.lo.y - beyond, room.hi.y + beyond)};
}

Box box_of_cell(const UniformGrid& grid, int column, int row) {
  const Vec2 centre = grid.cell_centre(column, row);
  return {centre - 0.5 * grid.cell(), centre + 0.5 * grid.cell()};
}

TEST(UniformGrid, APointIsInItsCellOrNearestToIt) {
  Rng rng(1, Purpose::scene);
  for (const UniformGrid& grid : {UniformGrid(room, 7), UniformGrid(room, 9, 4)}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec2 p = random_point(rng, 40);
      const int column = grid.find_column(p.x), row = grid.find_row(p.y);
      const Box own = box_of_cell(grid, column, row);
      const Vec2 inside{std::clamp(p.x, room.lo.x, room.hi.x),
                        std::clamp(p.y, room.lo.y, room.hi.y)};
      EXPECT_TRUE(own.grown(1e-9).contains(inside)) << p.x << ' ' << p.y;
      EXPECT_EQ(grid.number_at(p), grid.number(column, row));
      EXPECT_LT(grid.number_at(p), grid.size());
    }
  }
}

TEST(UniformGrid, CellsCoverTheBox) {
  const UniformGrid square(room, 7), divided(room, 9, 4);
  EXPECT_EQ(square.columns(), 15);
  EXPECT_EQ(square.rows(), 8);
  EXPECT_EQ(square.size(), 120u);
  EXPECT_EQ(divided.cell(), (Vec2{100.0 / 9, 12.5}));
  EXPECT_EQ(divided.size(), 36u);
}

TEST(UniformGrid, SweptCellsAreAllThatACapsuleMeetsAndFew) {
  Rng rng(2, Purpose::scene);
  const UniformGrid grid(room, 3);
  for (int i = 0; i < 400; ++i) {
    const Segment s{random_point(rng, 20), random_point(rng, 20)};
    const double reach = rng.uniform(0, 8);
    const UniformGrid::Sweep sweep(grid, s, reach, 1e-9);
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        Box cell = box_of_cell(grid, column, row);  // its part in the box
        cell = {cell.lo, {std::min(cell.hi.x, room.hi.x), std::min(cell.hi.y, room.hi.y)}};
        const Polygon outline{{cell.lo, {cell.hi.x, cell.lo.y}, cell.hi, {cell.lo.x, cell.hi.y}},
                              {}};
        const bool in_row = row >= sweep.rows().first && row <= sweep.rows().last;
        const bool swept =
            in_row && column >= sweep.columns(row).first && column <= sweep.columns(row).last;
        const double d = distance(s, outline);
        EXPECT_TRUE(swept || d > reach);
        // Beyond the box its outermost cells stand for all that is outside.
        const bool inner =
            row > 0 && column > 0 && row + 1 < grid.rows() && column + 1 < grid.columns();
        EXPECT_TRUE(!swept || !inner || d < 2 * (reach + 3));
      }
  }
}

TEST(UniformGrid, WhatIsBeyondABlockIsAtLeastAsFar) {
  Rng rng(3, Purpose::scene);
  const UniformGrid grid(room, 5);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p = random_point(rng, 0);
    const UniformGrid::Run columns{grid.find_column(p.x) - 1, grid.find_column(p.x) + 1};
    const UniformGrid::Run rows{grid.find_row(p.y), grid.find_row(p.y) + 2};
    const auto [left, right, bottom, top] = grid.beyond(columns, rows, p);
    const Vec2 other = random_point(rng, 0);
    EXPECT_TRUE(left <= p.x - other.x + 1e-9 || !(grid.find_column(other.x) < columns.first));
    EXPECT_TRUE(right <= other.x - p.x + 1e-9 || !(grid.find_column(other.x) > columns.last));
    EXPECT_TRUE(bottom <= p.y - other.y + 1e-9 || !(grid.find_row(other.y) < rows.first));
    EXPECT_TRUE(top <= other.y - p.y + 1e-9 || !(grid.find_row(other.y) > rows.last));
    EXPECT_EQ(left == infinity, columns.first <= 0);
    EXPECT_EQ(top == infinity, rows.last >= grid.rows() - 1);
  }
}

}  // namespace
}  // namespace microswarm
