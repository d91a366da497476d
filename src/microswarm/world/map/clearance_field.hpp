// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/world/obstacles/body_set.hpp"

namespace microswarm {

/// Bounds of the clearance on a grid of square cells, which answer most queries with one lookup.
/// The signed clearance of every point of a cell lies in [lower, lower + spread]. It is the
/// distance to the nearest wall or to the border; depth in a wall or outside the border is
/// negative. The bounds are derived from exact distances at the cell centres, since clearance
/// changes by at most 1 µm per µm, and stored rounded down. Every cell also stores the few edges
/// and discs that can be nearest to one of its points, so an exact distance costs little more than
/// the lookup.
class ClearanceField {
 public:
  ClearanceField() = default;
  /// Clearance to the bodies and to the border of `bounds`. `cell` [µm]; 0 chooses about 260,000
  /// cells. A cell size that gives more than 4 million cells is increased.
  ClearanceField(const Box& bounds, const BodySet& bodies, double cell = 0);

  /// Side of a cell [µm].
  double cell() const { return cell_; }
  /// Width of the bracket [µm]: the cell's diagonal plus an allowance for rounding.
  double spread() const { return spread_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Lower bound of the clearance at `p` [µm]; negative if `p` may be in a wall, -infinity outside
  /// the bounds.
  double lower(Vec2 p) const { return static_cast<double>(lower_[cell_at(p)]); }
  /// Whether a lower bound decides alone if a place is free with clearance r, which it then is if
  /// the bound is at least r. One comparison, since which of the two it is, is hard to predict.
  bool decides(double lower, double r) const {
    return std::abs(lower - (r - 0.5 * spread_)) > doubt_;
  }
  /// Exact distance [µm] from a point in the bounds to the nearest wall edge or disc (0 in a disc),
  /// ignoring the border; infinity if there are no walls. In a polygon it is the depth.
  double wall_distance(Vec2 p) const;
  /// For many places at once: sets free[i] to whether lower(places[i]) >= r, which is free for
  /// certain. Writes the numbers of the places that only an exact test can decide to `undecided`,
  /// which has room for all, and returns how many they are.
  std::size_t decide(std::span<const Vec2> positions, double r, std::span<std::uint8_t> free,
                     std::span<std::uint32_t> undecided) const;

  /// Data with which `decide` finds a position's cell, as cell_at does, and its bounds.
  struct Grid {
    Vec2 origin{};
    double per_cell, last_column, last_row;
    std::int32_t stride;
    const float* lower;
    double spread, doubt;
  };

 private:
  friend class FieldPainter;
  /// The grid is surrounded by one ring of cells that represent everything outside.
  std::size_t cell_at(Vec2 p) const {
    const double i = (p.x - origin_.x) * per_cell_;
    const double j = (p.y - origin_.y) * per_cell_;
    const int column = static_cast<int>(i > 0 ? (i < last_column_ ? i : last_column_) : 0);
    const int row = static_cast<int>(j > 0 ? (j < last_row_ ? j : last_row_) : 0);
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(column);
  }

  Vec2 origin_;
  double cell_ = 0;
  double per_cell_ = 0;
  double last_column_ = 0;
  double last_row_ = 0;
  std::size_t stride_ = 1;
  double spread_ = 0;
  double doubt_ = 0;  ///< half the spread and more than any rounding of what it is compared with
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> lower_{-std::numeric_limits<float>::infinity()};
  /// The one or two walls that can be nearest to a point of a cell. If `first` is is_list, `second`
  /// is the start of a longer list in lists_.
  struct Nearest {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
  };
  /// All points within `radius` of the core. An edge has radius 0; a disc has a point as core.
  struct Wall {
    Segment core;
    double radius = 0;
  };
  static constexpr std::uint32_t is_list = 1u << 31;

  static double distance_to(Vec2 p, const Wall& wall);

  std::vector<Nearest> nearest_;
  std::vector<std::uint32_t> lists_;  ///< wall · 2, odd for the last entry of a list
  std::vector<Wall> walls_;
};

}  // namespace microswarm
