// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <span>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Obstacle as input of `union_area`, relative to the query disc's centre: a disc, or the edges of
/// a polygon that meet the disc's bounding box.
struct NearObstacle {
  bool is_disc = false;
  Disc disc{};
  std::span<const Segment> edges{};
  /// Winding number of the whole polygon around the origin.
  int winding = 0;
};

/// Exact area [µm²] of the union of obstacles inside the disc of radius `radius` about the origin:
/// by `outline_area` if at most one obstacle is a polygon, which may stand for several that do not
/// overlap, else by `slab_area`. Where there are many discs, or the outline could be wrong among
/// many edges, `arc_area` takes the place of either. `memory` provides the work space. 0 if
/// stopped.
double union_area(double radius, std::span<const NearObstacle> obstacles,
                  std::pmr::memory_resource& memory, const Stop& stop = {});

}  // namespace microswarm
