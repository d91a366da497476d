// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Fixed points in square cells at least as wide as the query radius. All points within the radius
/// lie in three rows of three cells, and each row is contiguous in memory.
class SampleBuckets {
 public:
  SampleBuckets() = default;
  /// At least one point, and a radius [µm] above 0.
  SampleBuckets(std::span<const Vec2> points, double radius);

  /// Appends the indices of all other points within the radius (inclusive) of `p` to `out`; points
  /// exactly at `p` are left out.
  void append_near(Vec2 p, std::vector<std::uint32_t>& out) const;

 private:
  struct Placed {
    Vec2 position;
    std::uint32_t index = 0;
  };
  int index(double offset, int count) const {
    const double i = offset / cell_;
    return static_cast<int>(i > 0 ? std::min(i, count - 1.0) : 0);
  }

  double radius_ = 1;
  double cell_ = 1;
  Box box_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  ///< start of each cell in placed_, and the end
  std::vector<Placed> placed_;
};

}  // namespace microswarm
