// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Equal cells over a box, numbered row by row from the lower left. A point outside counts to the
/// nearest cell. It holds no contents.
class UniformGrid {
 public:
  /// Columns or rows from first to last; none if first > last.
  struct Run {
    int first = 0;
    int last = -1;
  };
  class Sweep;

  UniformGrid() = default;
  /// Square cells with sides of `cell` [µm] that cover the box.
  UniformGrid(const Box& box, double cell)
      : box_(box),
        cell_{cell, cell},
        per_cell_{1 / cell, 1 / cell},
        columns_(static_cast<int>(box.width() * per_cell_.x) + 1),
        rows_(static_cast<int>(box.height() * per_cell_.y) + 1) {}
  /// Cells that divide the box.
  UniformGrid(const Box& box, int columns, int rows)
      : box_(box),
        cell_{box.width() / columns, box.height() / rows},
        per_cell_{1 / cell_.x, 1 / cell_.y},
        columns_(columns),
        rows_(rows) {}

  const Box& box() const { return box_; }
  /// Sides of a cell [µm].
  Vec2 cell() const { return cell_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t size() const { return number(0, rows_); }

  int find_column(double x) const { return index((x - box_.lo.x) * per_cell_.x, columns_); }
  int find_row(double y) const { return index((y - box_.lo.y) * per_cell_.y, rows_); }
  Run column_range(const Box& box) const { return {find_column(box.lo.x), find_column(box.hi.x)}; }
  Run row_range(const Box& box) const { return {find_row(box.lo.y), find_row(box.hi.y)}; }
  std::size_t number(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t number_at(Vec2 p) const { return number(find_column(p.x), find_row(p.y)); }
  Vec2 cell_centre(int column, int row) const {
    return {box_.lo.x + (column + 0.5) * cell_.x, box_.lo.y + (row + 0.5) * cell_.y};
  }

  /// Distances [µm] from `p` to the cells beyond a block around it, on each side; infinity where
  /// the grid ends.
  struct Beyond {
    double left, right, bottom, top;
  };
  Beyond beyond(Run columns, Run rows, Vec2 p) const {
    const Vec2 o = p - box_.lo;
    return {columns.first > 0 ? o.x - columns.first * cell_.x : infinity,
            columns.last < columns_ - 1 ? (columns.last + 1) * cell_.x - o.x : infinity,
            rows.first > 0 ? o.y - rows.first * cell_.y : infinity,
            rows.last < rows_ - 1 ? (rows.last + 1) * cell_.y - o.y : infinity};
  }

 private:
  static int index(double i, int count) {
    const double last = count - 1;
    return static_cast<int>(i > 0 ? (i < last ? i : last) : 0);
  }

  Box box_;
  Vec2 cell_{1, 1};
  Vec2 per_cell_{1, 1};
  int columns_ = 0;
  int rows_ = 0;
};

/// The cells that a capsule may meet, row by row: in each row only the columns beside the segment.
/// Rows and the columns of an upright capsule are computed with one monotone rounding, so that two
/// capsules that share a point share a cell; `slack` exceeds any rounding error of a coordinate.
class UniformGrid::Sweep {
 public:
  Sweep(const UniformGrid& grid, Segment s, double reach, double slack)
      : grid_(grid), low_(s.a), high_(s.b), reach_(reach), margin_(reach + slack) {
    if (low_.y > high_.y) std::swap(low_, high_);
    left_ = std::min(low_.x, high_.x) - reach;
    right_ = std::max(low_.x, high_.x) + reach;
    if (bounds().overlaps(grid.box_)) rows_ = grid.row_range(bounds());
    is_slanted_ = rows_.first != rows_.last && high_.y - low_.y > slack;
    if (is_slanted_) slope_ = (high_.x - low_.x) / (high_.y - low_.y);
  }

  Run rows() const { return rows_; }
  Run columns(int row) const {
    double left = left_;
    double right = right_;
    if (is_slanted_) {
      const double bottom = grid_.box_.lo.y + row * grid_.cell_.y - margin_;
      const double enter = x_at(bottom);
      const double leave = x_at(bottom + grid_.cell_.y + 2 * margin_);
      left = std::max(left, std::min(enter, leave) - margin_);
      right = std::min(right, std::max(enter, leave) + margin_);
    }
    return {grid_.find_column(left), grid_.find_column(right)};
  }

 private:
  Box bounds() const { return {{left_, low_.y - reach_}, {right_, high_.y + reach_}}; }
  double x_at(double y) const {
    return low_.x + (std::clamp(y, low_.y, high_.y) - low_.y) * slope_;
  }

  const UniformGrid& grid_;
  Vec2 low_;
  Vec2 high_;
  double reach_;
  double margin_;
  double left_;
  double right_;
  double slope_ = 0;
  bool is_slanted_;
  Run rows_;
};

}  // namespace microswarm
