// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Obstacle as input of `union_area`, relative to the query disc's centre: a disc, or the edges of
/// a polygon that meet the disc's bounding box.
struct NearObstacle {
  bool is_disc = false;
  Disc disc;
  std::span<const Segment> edges;
  /// Winding number of the whole polygon around the origin.
  int winding = 0;
};

/// Exact area [µm²] of the union of obstacles inside the disc of radius `radius` about the origin.
/// The disc is cut into slabs at all vertices and crossings in it. Within a slab no two boundaries
/// cross, and the area between them is integrated in closed form. `memory` provides the work space.
double union_area(double radius, std::span<const NearObstacle> obstacles,
                  std::pmr::memory_resource& memory);

}  // namespace microswarm
