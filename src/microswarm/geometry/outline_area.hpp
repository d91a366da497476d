// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <optional>
#include <span>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Exact area [µm²] of (polygons ∪ discs) inside the disc of radius `radius` about the origin, by
/// Green's theorem along the parts of the outlines that are covered by no other obstacle. Takes the
/// `edges` of all polygons that meet the disc's bounding box and the polygons' `winding` number
/// around the origin; the polygons must not overlap one another, discs may overlap anything.
/// Nothing if shapes nearly coincide, or the origin is nearly on an outline, so that rounding could
/// decide. `memory` provides the work space.
std::optional<double> outline_area(double radius, std::span<const Segment> edges, int winding,
                                   std::span<const Disc> discs, std::pmr::memory_resource& memory);

}  // namespace microswarm
