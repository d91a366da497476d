// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/area.hpp"

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

/// Angle subtended by p → q at a point infinitesimally beside the origin; `side` is the side of the
/// line it is on.
double angle_seen(Vec2 p, Vec2 q, int side) {
  // The observer is at (δ, ε), so it sees a corner at the origin in the direction (−1, −0).
  if (p == Vec2{}) p = {-1, 0};
  if (q == Vec2{}) q = {-1, 0};
  return std::copysign(maths::atan2(cross(p, q), dot(p, q)), side);
}

}  // namespace

// The area is Σ triangles over the parts of edges inside the disc + Σ sectors over the parts
// outside, and all angles sum to 2π · winding. Hence it is r² π · winding + Σ (triangles − sectors)
// over the parts inside; edges outside the disc do not contribute.
double area_of_edge(Disc disc, Segment edge) {
  const Vec2 a = edge.a - disc.centre;
  const Vec2 b = edge.b - disc.centre;
  const Vec2 along = b - a;
  const double r2 = disc.radius * disc.radius;
  const double length2 = squared_norm(along);
  const double height = cross(a, along);
  const double chord2 = r2 * length2 - height * height;
  if (!(chord2 > 0)) return 0;
  const double half = std::sqrt(chord2);
  const double middle = -dot(a, along);
  const double enter = std::max((middle - half) / length2, 0.0);
  const double leave = std::min((middle + half) / length2, 1.0);
  if (!(enter < leave)) return 0;
  const Vec2 p = enter > 0 ? a + enter * along : a;
  const Vec2 q = leave < 1 ? a + leave * along : b;
  const int side = orientation_beside(edge.a, edge.b, disc.centre);
  return 0.5 * ((leave - enter) * height - r2 * angle_seen(p, q, side));
}

double intersection_area(Disc disc, const Polygon& polygon) {
  const Box box = Box{disc.centre, disc.centre}.grown(disc.radius);
  int winding = 0;
  double sum = 0;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    winding += winding_of_edge(a, b, disc.centre);
    if (std::min(a.y, b.y) < box.hi.y && std::max(a.y, b.y) > box.lo.y &&
        std::min(a.x, b.x) < box.hi.x && std::max(a.x, b.x) > box.lo.x) {
      sum += area_of_edge(disc, {a, b});
    }
  });
  return std::clamp(winding * area(disc) + sum, 0.0, area(disc));
}

double intersection_area(Disc a, Disc b) {
  const double d = distance(a.centre, b.centre);
  const double both = a.radius + b.radius;
  const double less = a.radius - b.radius;
  if (d >= both) return 0;
  if (d <= std::abs(less)) return area(less < 0 ? a : b);
  // Half the common chord by Heron's formula, and its distance from either centre.
  const double half = std::sqrt((both + d) * (both - d) * (d + less) * (d - less)) / (2 * d);
  const double from_a = 0.5 * (d + less * both / d);
  const double from_b = 0.5 * (d - less * both / d);
  const double lens = a.radius * a.radius * maths::atan2(half, from_a) +
                      b.radius * b.radius * maths::atan2(half, from_b) - d * half;
  return std::clamp(lens, 0.0, area(less < 0 ? a : b));
}

double covered_area(Disc disc, const EdgeGrid& grid) {
  double sum = grid.winding(disc.centre) * area(disc);
  grid.for_each_in(Box{disc.centre, disc.centre}.grown(disc.radius),
                   [&](std::size_t i) { sum += area_of_edge(disc, grid.edge(i)); });
  return std::clamp(sum, 0.0, area(disc));
}

}  // namespace microswarm
