// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Exact area of disc ∩ polygon [µm²] (Green's theorem over the clipped boundary).
double intersection_area(Disc disc, const Polygon& polygon);

/// Exact area of the common lens of two discs [µm²].
double intersection_area(Disc a, Disc b);

/// Exact area of `disc` ∩ (union of polygons and discs) [µm²]: where obstacles overlap, they count
/// once. Closed form per slab between all vertices and crossings inside the disc.
double covered_area(Disc disc, std::span<const Polygon* const> polygons,
                    std::span<const Disc> discs);

}  // namespace microswarm
