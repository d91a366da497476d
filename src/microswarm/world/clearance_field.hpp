// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/world/body_set.hpp"

namespace microswarm {

/// Bounds of the clearance on a grid of square cells, so that one lookup answers most queries: the
/// true clearance anywhere in a cell lies within [lower, lower + 2·margin]. Made from exact
/// distances at the cell centres (clearance changes by at most 1 µm per µm).
class ClearanceField {
 public:
  ClearanceField() = default;
  /// Clearance to the bodies and to the border of `bounds`. `cell` [µm]; 0 chooses one so that
  /// there are at most about 260,000 cells.
  ClearanceField(const Box& bounds, const BodySet& bodies, double cell = 0);

  double cell() const { return cell_; }
  /// Width of the bracket [µm]: the cell's diagonal.
  double spread() const { return spread_; }
  /// No wall is nearer to `p` than this [µm]; negative when `p` may be in a wall or outside.
  double lower(Vec2 p) const {
    const double i = (p.x - origin_.x) * per_cell_;
    const double j = (p.y - origin_.y) * per_cell_;
    if (!(i >= 0 && j >= 0 && i < columns_ && j < rows_)) return -1;
    return lower_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(i)];
  }

 private:
  Vec2 origin_;
  double cell_ = 0;
  double per_cell_ = 0;
  double spread_ = 0;
  double columns_ = 0;
  double rows_ = 0;
  std::vector<float> lower_;
};

}  // namespace microswarm
