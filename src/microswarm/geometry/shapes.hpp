// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Straight piece from `a` to `b`; both ends belong to it, and they may coincide.
struct Segment {
  Vec2 a;
  Vec2 b;
};

/// Closed disc.
struct Disc {
  Vec2 centre;
  double radius = 0;
};

/// Axis-aligned box; empty when a `lo` coordinate exceeds its `hi`.
struct Box {
  Vec2 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  double width() const { return hi.x - lo.x; }
  double height() const { return hi.y - lo.y; }
  Vec2 centre() const { return 0.5 * (lo + hi); }
  bool contains(Vec2 p) const { return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y; }
  void include(Vec2 p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  Box grown(double d) const { return {{lo.x - d, lo.y - d}, {hi.x + d, hi.y + d}}; }
  bool overlaps(const Box& o) const {
    return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y;
  }
};

/// Closed polygon: the outer ring counter-clockwise, holes clockwise, no ring repeats its first
/// vertex. Rings may touch in single points (as traced pixels do) but not cross.
struct Polygon {
  std::vector<Vec2> outer;
  std::vector<std::vector<Vec2>> holes;
};

/// Smallest box that holds the points; empty when there are none.
Box bounding_box(std::span<const Vec2> points);
/// Smallest box that holds the polygon.
Box bounding_box(const Polygon& polygon);
/// Smallest box that holds the disc.
inline Box bounding_box(const Disc& disc) {
  return Box{disc.centre, disc.centre}.grown(disc.radius);
}
/// Signed area of a ring [µm²], positive when counter-clockwise.
double signed_area(std::span<const Vec2> ring);
/// Centroid of the area within a ring; the middle of its box where it encloses none.
Vec2 centroid(std::span<const Vec2> ring);
/// Area of the polygon less its holes [µm²].
double area(const Polygon& polygon);
/// The polygon with its rings turned the way `Polygon` asks for, repeated and last = first vertices
/// removed; rings of fewer than three vertices vanish.
Polygon normalised(Polygon polygon);
/// Every edge of every ring, in order; `visit(Vec2 a, Vec2 b)`.
template <class Visit>
void for_each_edge(const Polygon& polygon, Visit&& visit) {
  auto ring = [&](const std::vector<Vec2>& r) {
    for (std::size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) visit(r[j], r[i]);
  };
  ring(polygon.outer);
  for (const auto& hole : polygon.holes) ring(hole);
}

}  // namespace microswarm
