// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <span>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// The same as `outline_area`, for many shapes, and for shapes that touch or nearly coincide. The
/// covered angles of each circle are united until none is left, so a disc deep among others costs
/// few comparisons. The crossings of two circles are computed once for both, so that the outline
/// closes. 0 if stopped.
double arc_area(double radius, std::span<const Segment> edges, int winding,
                std::span<const Disc> discs, std::pmr::memory_resource& memory,
                const Stop& stop = {});

}  // namespace microswarm
