// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Union of polygons by non-zero winding, which also repairs self-intersecting rings. New vertices
/// at edge crossings lie on a grid of about 1e-12 of the extent; other vertices are unchanged. The
/// results touch one another at most in single points. Throws InputError for edges that meet too
/// often, or so many beside each other that it would take more than max_union_steps.
std::vector<Polygon> united(std::span<const Polygon> polygons);

/// Edges that a sweep from vertex to vertex meets, in all.
inline constexpr double max_union_steps = 5e8;

/// The box minus the polygons; vertices as in `united`.
std::vector<Polygon> difference(const Box& box, std::span<const Polygon> polygons);

}  // namespace microswarm
