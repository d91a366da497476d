// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// An obstacle as `union_area` takes it, in coordinates about the query disc's centre: a disc, or
/// the edges of a polygon that meet the disc's bounding box.
struct NearObstacle {
  bool is_disc = false;
  Disc disc;
  std::span<const Segment> edges;
  /// Winding number of the whole polygon around the origin.
  int winding = 0;
};

/// Exact area [µm²] of the union of obstacles inside the disc of radius `radius` about the origin:
/// slabs between all vertices and crossings in the disc; within a slab no two boundaries cross, and
/// what lies between them is integrated in closed form. `memory` holds the work space.
double union_area(double radius, std::span<const NearObstacle> obstacles,
                  std::pmr::memory_resource& memory);

}  // namespace microswarm
