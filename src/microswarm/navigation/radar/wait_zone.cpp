// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/wait_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

/// Rectangle in any orientation.
struct Frame {
  Vec2 centre;
  Vec2 along;  ///< unit vector
  double half_length = 0;
  double half_width = 0;

  Vec2 local(Vec2 p) const { return {dot(p - centre, along), cross(along, p - centre)}; }
  double distance_to(Vec2 p) const {
    const Vec2 q = local(p);
    return norm(
        {std::max(0.0, std::abs(q.x) - half_length), std::max(0.0, std::abs(q.y) - half_width)});
  }
};

double gap(const Disc& a, const Disc& b) {
  return distance(a.centre, b.centre) - a.radius - b.radius;
}
double gap(const Disc& a, const Polygon& b) { return distance(a.centre, b) - a.radius; }
double gap(const Polygon& a, const Disc& b) { return gap(b, a); }
double gap(const Polygon& a, const Polygon& b) {
  double least = distance(a.outer.front(), b);  // 0 if a is inside b
  least = std::min(least, distance(b.outer.front(), a));
  for_each_edge(a, [&](Vec2 p, Vec2 q) { least = std::min(least, distance(Segment{p, q}, b)); });
  return least;
}

Vec2 body_middle(const Body& body) {
  return std::visit(
      Overloaded{[](const Disc& disc) { return disc.centre; },
                 [](const Polygon& polygon) { return bounding_box(polygon).centre(); }},
      body.shape);
}

/// Extent of the body along a unit vector.
Range extent(const Body& body, Vec2 along) {
  return std::visit(Overloaded{[&](const Disc& disc) {
                                 const double at = dot(disc.centre, along);
                                 return Range{at - disc.radius, at + disc.radius};
                               },
                               [&](const Polygon& polygon) {
                                 Range range{infinity, -infinity};
                                 for (const Vec2 v : polygon.outer) {
                                   range.min = std::min(range.min, dot(v, along));
                                   range.max = std::max(range.max, dot(v, along));
                                 }
                                 return range;
                               }},
                    body.shape);
}

Range united(Range a, Range b) { return {std::min(a.min, b.min), std::max(a.max, b.max)}; }

/// Rectangle of both leaves and the passage between them, aligned with the line through their
/// centres.
Frame zone_frame(const Body& a, const Body& b) {
  const Vec2 between = body_middle(b) - body_middle(a);
  const double length = norm(between);
  const Vec2 along = length > 0 ? between / length : Vec2{1, 0};
  const Vec2 across = perpendicular(along);
  const Range x = united(extent(a, along), extent(b, along));
  const Range y = united(extent(a, across), extent(b, across));
  return {.centre = 0.5 * (x.min + x.max) * along + 0.5 * (y.min + y.max) * across,
          .along = along,
          .half_length = 0.5 * (x.max - x.min),
          .half_width = 0.5 * (y.max - y.min)};
}

Frame zone_frame(const WaitZone& area) {
  return {area.centre, unit_vector(area.heading), area.width / 2, area.height / 2};
}

}  // namespace

bool contains(const WaitZone& area, Vec2 p) { return zone_frame(area).distance_to(p) <= 0; }

Polygon zone_outline(const WaitZone& area) {
  const Frame frame = zone_frame(area);
  const Vec2 x = frame.half_length * frame.along;
  const Vec2 y = frame.half_width * perpendicular(frame.along);
  return {{area.centre - x - y, area.centre + x - y, area.centre + x + y, area.centre - x + y}, {}};
}

double gap_between(const Body& a, const Body& b) {
  const double between =
      std::visit([](const auto& s, const auto& t) { return gap(s, t); }, a.shape, b.shape);
  return std::max(0.0, between);
}

bool must_wait(const WaitZone& area, std::span<const Body> bodies, const Waiting& swarm) {
  const Frame A = zone_frame(area);
  if (A.distance_to(swarm.position) > swarm.radius) return false;
  for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
    if (bodies[i].obstacle != bodies[i + 1].obstacle) continue;
    const Frame valve = zone_frame(bodies[i], bodies[i + 1]);
    if (A.distance_to(valve.centre) > 0) continue;
    const bool passed = valve.local(swarm.position).y * valve.local(swarm.target).y > 0;
    const bool is_safe = valve.distance_to(swarm.position) >= swarm.reach;
    if (!passed && is_safe && gap_between(bodies[i], bodies[i + 1]) < area.min_gap) return true;
  }
  return false;
}

}  // namespace microswarm::navigation
