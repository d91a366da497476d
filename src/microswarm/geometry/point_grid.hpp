// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Growing set of points in the plane with exact nearest-neighbour and radius queries: a bucket
/// grid that is built anew, finer, as points arrive, and splits a crowded cell into a grid of its
/// own. Points keep the index in which they were added; ties go to the lower index, so that answers
/// do not depend on the grid. Queries are safe to run in several threads.
class PointGrid {
 public:
  /// Points are expected, but not required, to lie in `box`.
  explicit PointGrid(const Box& box);

  void add(Vec2 p);
  /// Forgets the points, keeps the box and the memory.
  void clear();
  std::size_t size() const { return points_.size(); }
  bool empty() const { return points_.empty(); }
  Vec2 operator[](std::size_t i) const { return points_[i]; }

  /// Index of the nearest point; the set must not be empty.
  std::uint32_t nearest(Vec2 p) const;
  /// Appends the indices of all points within `radius` (inclusive) to `out`, ascending.
  void within(Vec2 p, double radius, std::vector<std::uint32_t>& out) const;

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// A cell holds a chain of points, or (from the moment it is crowded) a grid of its own.
  struct Cell {
    std::uint32_t first = none;
    std::uint32_t count = 0;
    std::uint32_t grid = none;
  };
  /// Points beyond the box are kept in its outermost cells.
  struct Grid {
    Vec2 origin;
    double cell;
    double per_cell;
    double slack;
    int columns;
    int rows;
    std::uint32_t cells;

    int column_of(double x) const { return index((x - origin.x) * per_cell, columns); }
    int row_of(double y) const { return index((y - origin.y) * per_cell, rows); }
    static int index(double i, int count) {
      const double last = count - 1;
      return static_cast<int>(i > 0 ? (i < last ? i : last) : 0);
    }
  };
  struct Found {
    double squared;
    std::uint32_t point;
  };

  std::uint32_t add_grid(const Box& box, double cells);
  void insert(std::uint32_t point);
  void split(Cell& cell);
  void rebuild();
  void search(const Grid& grid, Vec2 p, Found& best) const;
  void scan(const Cell& cell, Vec2 p, Found& best) const;
  void collect(const Grid& grid, Vec2 p, double radius, std::vector<std::uint32_t>& out) const;

  Box box_;
  std::vector<Vec2> points_;
  std::vector<std::uint32_t> next_;
  std::vector<Grid> grids_;
  std::vector<Cell> cells_;
  std::size_t rebuild_at_ = 0;
};

}  // namespace microswarm
