// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Side of `c` seen along a → b: +1 left, −1 right, 0 exactly on the line. Exact for all finite
/// doubles that do not overflow: a floating-point filter, then expansion arithmetic.
int orientation(Vec2 a, Vec2 b, Vec2 c);

/// Do two closed segments share a point? Exact, for touching, collinear and degenerate ones too.
bool intersects(Segment s, Segment t);

/// Where a point lies in a polygon.
enum class Side { outside, boundary, inside };

/// Exact position of `p` in the polygon (holes are outside, their rings boundary).
Side locate(const Polygon& polygon, Vec2 p);

}  // namespace microswarm
