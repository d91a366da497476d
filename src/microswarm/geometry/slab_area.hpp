// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <span>

#include "microswarm/geometry/union_area.hpp"

namespace microswarm {

/// The same as `union_area`, for all kinds of obstacles, also overlapping polygons. The disc is cut
/// into slabs at all vertices and crossings in it. Within a slab no two boundaries cross, and the
/// area between them is integrated in closed form. 0 if stopped.
double slab_area(double radius, std::span<const NearObstacle> obstacles,
                 std::pmr::memory_resource& memory, const Stop& stop = {});

}  // namespace microswarm
