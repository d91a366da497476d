// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/uniform_grid.hpp"

namespace microswarm::planning {

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
  double radius_ = 1;
  UniformGrid grid_;
  std::vector<std::uint32_t> first_;  ///< start of each cell in placed_, and the end
  std::vector<Placed> placed_;
};

}  // namespace microswarm::planning
