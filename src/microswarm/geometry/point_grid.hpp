// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Growing set of points in the plane with exact nearest-neighbour and radius queries: a bucket
/// grid that refines itself as points arrive. Points keep the index in which they were added; ties
/// go to the lower index, so that answers do not depend on the grid.
class PointGrid {
 public:
  /// Points are expected, but not required, to lie in `box`.
  explicit PointGrid(const Box& box);

  void add(Vec2 p);
  void clear();
  std::size_t size() const { return points_.size(); }
  Vec2 operator[](std::size_t i) const { return points_[i]; }

  /// Index of the nearest point; the set must not be empty.
  std::uint32_t nearest(Vec2 p) const;
  /// Appends the indices of all points within `radius` (inclusive) to `out`, ascending.
  void within(Vec2 p, double radius, std::vector<std::uint32_t>& out) const;

 private:
  std::vector<Vec2> points_;
};

}  // namespace microswarm
