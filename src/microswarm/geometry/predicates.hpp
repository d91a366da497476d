// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// The answer of `orientation` where rounding leaves it open; slow.
int exact_orientation(Vec2 a, Vec2 b, Vec2 c);

/// Side of `c` seen along a → b: +1 left, −1 right, 0 exactly on the line. Exact for all finite
/// coordinates below 1e150: a floating-point filter, then expansion arithmetic.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  // Rounding moves det by at most (3 + 16u) u (|left| + |right|), u = 2⁻⁵³; 2⁻¹⁰⁰⁰ for underflow.
  const double bound = 3.330669073875472e-16 * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exact_orientation(a, b, c);
}

/// Do two closed segments share a point? Exact, for touching, collinear and degenerate ones too.
bool intersects(Segment s, Segment t);

/// Does the closed segment contain `p`? Exact.
inline bool contains(Segment s, Vec2 p) {
  return p.x >= std::min(s.a.x, s.b.x) && p.x <= std::max(s.a.x, s.b.x) &&
         p.y >= std::min(s.a.y, s.b.y) && p.y <= std::max(s.a.y, s.b.y) &&
         orientation(s.a, s.b, p) == 0;
}

/// Where a point lies in a polygon.
enum class Side { outside, boundary, inside };

/// Exact position of `p` in the polygon (holes are outside, their rings boundary).
Side locate(const Polygon& polygon, Vec2 p);

}  // namespace microswarm
