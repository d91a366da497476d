// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/distance.hpp"

#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

double squared_distance_to_boundary(Vec2 p, const Polygon& polygon) {
  double best = std::numeric_limits<double>::infinity();
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    best = std::min(best, squared_distance(p, {a, b}));
  });
  return best;
}

/// Parameter on s (unclamped fraction) of the point nearest to `p`; 0 if s is a point.
double projected_fraction(Segment s, Vec2 p) {
  const Vec2 along = s.b - s.a;
  const double length2 = squared_norm(along);
  return length2 > 0 ? dot(p - s.a, along) / length2 : 0;
}

/// Fraction where s enters the circle, from the chord about the foot of the perpendicular;
/// no_contact if it misses the circle or starts inside.
double entry(Segment s, double r, Vec2 centre) {
  const Vec2 along = s.b - s.a;
  const double length2 = squared_norm(along);
  if (length2 == 0) return no_contact;
  const double offset = cross(along, centre - s.a);
  const double chord2 = r * r * length2 - offset * offset;
  if (chord2 < 0) return no_contact;
  const double t = (dot(centre - s.a, along) - std::sqrt(chord2)) / length2;
  return t >= 0 && t <= 1 ? t : no_contact;
}

/// Fraction where s comes within r of the interior of the wall, measured perpendicularly.
double entry(Segment s, double r, Segment wall) {
  const Vec2 along = wall.b - wall.a;
  const double length = norm(along);
  if (length == 0) return no_contact;
  const double start = cross(along, s.a - wall.a) / length;
  const double climb = cross(along, s.b - s.a) / length;
  if (climb == 0 || (start > 0) == (climb > 0)) return no_contact;
  const double t = (std::abs(start) - r) / std::abs(climb);
  if (!(t >= 0 && t <= 1)) return no_contact;
  const double foot = projected_fraction(wall, s.a + t * (s.b - s.a));
  return foot >= 0 && foot <= 1 ? t : no_contact;
}

}  // namespace

double squared_distance(Segment s, Segment t) {
  if (intersects(s, t)) return 0;
  return std::min(std::min(squared_distance(t.a, s), squared_distance(t.b, s)),
                  std::min(squared_distance(s.a, t), squared_distance(s.b, t)));
}

double distance(Vec2 p, const Polygon& polygon) {
  return std::max(0.0, signed_distance(p, polygon));
}

double distance(Segment s, const Polygon& polygon) {
  if (locate(polygon, s.a) != Side::outside) return 0;
  double best = std::numeric_limits<double>::infinity();
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    best = std::min(best, squared_distance(s, {a, b}));
  });
  return std::sqrt(best);
}

double signed_distance(Vec2 p, const Polygon& polygon) {
  const double d = std::sqrt(squared_distance_to_boundary(p, polygon));
  switch (locate(polygon, p)) {
    case Side::inside:
      return -d;
    case Side::boundary:
      return 0;
    case Side::outside:
      break;
  }
  return d;
}

Vec2 nearest_point(Vec2 p, Segment s) {
  const double t = projected_fraction(s, p);
  if (t <= 0) return s.a;
  if (t >= 1) return s.b;
  return s.a + t * (s.b - s.a);
}

double first_contact(Segment s, double r, Segment wall) {
  if (r == 0 ? contains(wall, s.a) : squared_distance(s.a, wall) <= r * r) return 0;
  if (r == 0 ? !intersects(s, wall) : squared_distance(s, wall) > r * r) return no_contact;
  const double t = std::min(entry(s, r, wall), std::min(entry(s, r, wall.a), entry(s, r, wall.b)));
  if (t <= 1) return t;
  // Grazing contact whose entry was lost to rounding: use the nearest approach.
  double best = squared_distance(s.b, wall);
  double at = 1;
  for (const Vec2 end : {wall.a, wall.b}) {
    const double d = squared_distance(end, s);
    const double f = std::clamp(projected_fraction(s, end), 0.0, 1.0);
    if (d < best || (d == best && f < at)) {
      best = d;
      at = f;
    }
  }
  return at;
}

double first_contact(Segment s, double r, Disc disc) {
  const double reach = r + disc.radius;
  if (squared_norm(s.a - disc.centre) <= reach * reach) return 0;
  if (squared_distance(disc.centre, s) > reach * reach) return no_contact;
  const double t = entry(s, reach, disc.centre);
  return t <= 1 ? t : std::clamp(projected_fraction(s, disc.centre), 0.0, 1.0);
}

double first_contact(Segment s, double r, const Polygon& polygon) {
  if (locate(polygon, s.a) != Side::outside) return 0;
  double first = no_contact;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    first = std::min(first, first_contact(s, r, Segment{a, b}));
  });
  return first;
}

}  // namespace microswarm
