// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Line segment from `a` to `b`, including both ends, which may coincide.
struct Segment {
  Vec2 a{};
  Vec2 b{};
};

/// Closed disc.
struct Disc {
  Vec2 centre{};
  double radius = 0;
};

/// Axis-aligned box; empty if a `lo` coordinate exceeds its `hi`.
struct Box {
  Vec2 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  /// Sides [µm].
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

/// Closed polygon. The outer ring is counter-clockwise, holes are clockwise, and no ring repeats
/// its first vertex. Rings may touch in single points (as traced pixels do) but not cross.
struct Polygon {
  std::vector<Vec2> outer{};
  std::vector<std::vector<Vec2>> holes{};
};

/// Smallest box around the points; empty if there are none.
Box bounding_box(std::span<const Vec2> points);
/// Smallest box around the polygon.
Box bounding_box(const Polygon& polygon);
/// Smallest box around the disc.
inline Box bounding_box(const Disc& disc) {
  return Box{disc.centre, disc.centre}.grown(disc.radius);
}
/// Signed area of a ring [µm²], positive if counter-clockwise.
double signed_area(std::span<const Vec2> ring);
/// Centroid of the area within a ring; the middle of its box where it encloses none.
Vec2 centroid(std::span<const Vec2> ring);
/// Area of the polygon less its holes [µm²].
double area(const Polygon& polygon);
/// The polygon with its rings oriented as `Polygon` requires and without repeated vertices. Rings
/// of fewer than three vertices are removed.
Polygon normalised(Polygon polygon);
/// Calls `visit(Vec2 a, Vec2 b)` for every edge of every ring, in order.
template <class Visit>
void for_each_edge(const Polygon& polygon, Visit&& visit) {
  auto ring = [&](const std::vector<Vec2>& r) {
    for (std::size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) visit(r[j], r[i]);
  };
  ring(polygon.outer);
  for (const auto& hole : polygon.holes) ring(hole);
}

}  // namespace microswarm
