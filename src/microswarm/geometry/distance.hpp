// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Squared distance [µm²] and distance [µm] between closed sets; 0 if they share a point.
inline double squared_distance(Vec2 p, Segment s) {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const double t = dot(to_p, along);
  const double length2 = squared_norm(along);
  const double area = cross(along, to_p);
  const double to_line = area * area / length2;
  const double to_end = squared_norm(t <= 0 ? to_p : p - s.b);
  return t > 0 && t < length2 ? to_line : to_end;
}
double squared_distance(Segment s, Segment t);
inline double distance(Vec2 p, Segment s) { return std::sqrt(squared_distance(p, s)); }
inline double distance(Segment s, Segment t) { return std::sqrt(squared_distance(s, t)); }
double distance(Vec2 p, const Polygon& polygon);
double distance(Segment s, const Polygon& polygon);
inline double distance(Vec2 p, Disc d) { return std::max(0.0, distance(p, d.centre) - d.radius); }
inline double distance(Segment s, Disc d) {
  return std::max(0.0, distance(d.centre, s) - d.radius);
}
/// Distance to the boundary [µm], negative inside.
double signed_distance(Vec2 p, const Polygon& polygon);

/// Point of the segment nearest to `p`.
Vec2 nearest_point(Vec2 p, Segment s);

/// First contact (distance <= r) of a disc of radius `r` whose centre moves from s.a to s.b, as a
/// fraction of the segment in [0, 1]; 0 if they touch at the start, no_contact if never.
inline constexpr double no_contact = 2;
double first_contact(Segment s, double r, Segment wall);
double first_contact(Segment s, double r, Disc disc);
double first_contact(Segment s, double r, const Polygon& polygon);

}  // namespace microswarm
