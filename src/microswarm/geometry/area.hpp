// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Area of the disc [µm²].
inline double area(Disc disc) { return pi * disc.radius * disc.radius; }

/// Exact area of disc ∩ polygon [µm²] (Green's theorem over the clipped boundary).
double intersection_area(Disc disc, const Polygon& polygon);

/// Exact area of the common lens of two discs [µm²].
double intersection_area(Disc a, Disc b);

/// Exact area of `disc` ∩ (union of polygons and discs) [µm²]; overlaps count once. Obstacles that
/// overlap no other are summed. The others are cut into slabs between all vertices and crossings
/// inside the disc, and each slab is integrated in closed form; see `union_area`. Of no meaning if
/// stopped.
double covered_area(Disc disc, std::span<const Polygon* const> polygons,
                    std::span<const Disc> discs, const Stop& stop = {});

/// Exact area of `disc` ∩ solid [µm²], from the edges near the disc alone. Bodies may touch;
/// overlapping bodies count separately.
double covered_area(Disc disc, const EdgeGrid& grid);

/// Contribution of the edge to the area of disc ∩ solid, besides the whole disc if its centre
/// (moved as in `winding_of_edge`) is in the solid. With t the part of the edge in the disc, it is
/// the triangle minus the sector over t. Sum it over all edges of the solid.
double area_of_edge(Disc disc, Segment edge);

}  // namespace microswarm
