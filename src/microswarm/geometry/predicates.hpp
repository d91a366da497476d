// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Exact `orientation` for cases that rounding leaves undecided; slow.
int exact_orientation(Vec2 a, Vec2 b, Vec2 c);

/// Side of `c` relative to the line a → b: +1 left, −1 right, 0 exactly on it. Exact for all finite
/// coordinates below 1e150: a floating-point filter, then expansion arithmetic.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  // Rounding errors of det are at most (3 + 16u) u (|left| + |right|), u = 2⁻⁵³; 2⁻¹⁰⁰⁰ covers
  // underflow.
  const double bound = 3.330669073875472e-16 * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exact_orientation(a, b, c);
}

/// `orientation` of p moved by an infinitesimal (δ, ε) with 0 < ε ≪ δ, so that it lies on no line.
/// Never 0 unless a = b.
inline int orientation_beside(Vec2 a, Vec2 b, Vec2 p) {
  const int side = orientation(a, b, p);
  if (side != 0) return side;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return a.x < b.x ? 1 : a.x > b.x ? -1 : 0;
}

/// Contribution of the edge a → b to the winding number around p moved by (δ, ε): ±1 if it passes
/// on the right (upwards +1), else 0. The sum over closed rings is exact.
inline int winding_of_edge(Vec2 a, Vec2 b, Vec2 p) {
  if ((a.y <= p.y) == (b.y <= p.y) || p.x > std::max(a.x, b.x)) return 0;
  const int turn = b.y > a.y ? 1 : -1;
  return p.x < std::min(a.x, b.x) || orientation_beside(a, b, p) == turn ? turn : 0;
}

/// Contribution of the edge a → b to the change of the winding number along the path from `from`
/// horizontally to (to.x, from.y), then vertically to `to`, all moved by the same (δ, ε). Only
/// edges that meet the path count.
inline int winding_along(Vec2 a, Vec2 b, Vec2 from, Vec2 to) {
  if (std::min(a.x, b.x) > std::max(from.x, to.x) || std::max(a.x, b.x) < std::min(from.x, to.x)) {
    return 0;
  }
  const Vec2 turn{to.x, from.y};
  auto is_left = [&](Vec2 p) { return orientation_beside(a, b, p) > 0; };
  int sum = 0;
  if ((a.y <= from.y) != (b.y <= from.y)) sum += is_left(turn) - is_left(from);
  if ((a.x <= to.x) != (b.x <= to.x)) sum += is_left(to) - is_left(turn);
  return sum;
}

/// Whether two closed segments share a point. Exact, also for touching, collinear and degenerate
/// ones.
bool intersects(Segment s, Segment t);

/// Whether the closed segment contains `p`. Exact.
inline bool contains(Segment s, Vec2 p) {
  return p.x >= std::min(s.a.x, s.b.x) && p.x <= std::max(s.a.x, s.b.x) &&
         p.y >= std::min(s.a.y, s.b.y) && p.y <= std::max(s.a.y, s.b.y) &&
         orientation(s.a, s.b, p) == 0;
}

/// Position of a point relative to a polygon.
enum class Side { outside, boundary, inside };

/// Exact position of `p` relative to the polygon; holes are outside, their rings boundary.
Side locate(const Polygon& polygon, Vec2 p);

}  // namespace microswarm
