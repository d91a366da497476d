// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Union of polygons by non-zero winding, which also repairs self-intersecting rings. New vertices
/// at edge crossings lie on a grid of about 1e-12 of the extent; other vertices are unchanged. The
/// results touch one another at most in single points.
std::vector<Polygon> united(std::span<const Polygon> polygons);

/// The box minus the polygons; vertices as in `united`.
std::vector<Polygon> difference(const Box& box, std::span<const Polygon> polygons);

}  // namespace microswarm
