// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Union of polygons (non-zero winding, so that a ring that crosses itself is mended too). New
/// vertices, where edges cross, lie on a grid of about 1e-12 of the extent; the others keep their
/// bits. The results touch one another in single points at most.
std::vector<Polygon> united(std::span<const Polygon> polygons);

/// The box less the polygons, in the same manner.
std::vector<Polygon> difference(const Box& box, std::span<const Polygon> polygons);

}  // namespace microswarm
