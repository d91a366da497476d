// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/body_set.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {

BodySet::BodySet(std::vector<Body> bodies, bool apart) : bodies_(std::move(bodies)), apart_(apart) {
  index();
}

void BodySet::assign(std::span<const Body> bodies) {
  bodies_.assign(bodies.begin(), bodies.end());
  apart_ = false;
  index();
}

void BodySet::index() {
  discs_.assign(bodies_);
  polygons_.assign(bodies_);
}

bool BodySet::holds(Vec2 p) const { return !discs_.is_free(p, 0) || polygons_.holds(p); }

double BodySet::clearance(Vec2 p, double limit) const {
  const double to_disc = discs_.empty() ? limit : discs_.clearance(p, limit);
  if (polygons_.empty()) return to_disc;
  const double d = polygons_.edge_distance(p, to_disc);
  return d > 0 && polygons_.holds(p) ? 0 : d;
}

double BodySet::clearance(Segment s, double limit) const {
  const double to_disc = discs_.empty() ? limit : discs_.clearance(s, limit);
  if (polygons_.empty()) return to_disc;
  const double d = polygons_.edge_distance(s, to_disc);
  return d > 0 && polygons_.holds(s.a) ? 0 : d;
}

// Most points that are not free are in a body, which one cell decides.
bool BodySet::is_free(Vec2 p, double r) const {
  return (polygons_.empty() || !polygons_.holds(p)) && is_free_from_outside({p, p}, r);
}

bool BodySet::is_free(Segment s, double r) const {
  return is_free_from_outside(s, r) && (polygons_.empty() || !polygons_.holds(s.a));
}

bool BodySet::is_free_from_outside(Segment s, double r) const {
  return (discs_.empty() || (s.a == s.b ? discs_.is_free(s.a, r) : discs_.is_free(s, r))) &&
         (polygons_.empty() || polygons_.edges_free(s, r));
}

std::size_t BodySet::nearest(Vec2 p, double limit) const {
  const std::size_t disc = discs_.nearest(p, limit);
  const std::uint32_t edge = polygons_.nearest(p, limit);
  const bool some_disc = disc < discs_.size();
  const bool some_edge = edge != PolygonSet::none;
  if (some_disc && distance(p, discs_.disc(disc)) == 0) return discs_.enclosing_pose(disc);
  if (!polygons_.empty() && polygons_.holds(p)) {
    if (some_edge && depth_in(bodies_[edge], p) >= 0) return edge;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (is_in_polygon(p, bodies_[i])) return i;
  }
  if (some_disc && some_edge) {
    return distance(p, discs_.disc(disc)) <= polygons_.edge_distance(p, limit)
               ? discs_.enclosing_pose(disc)
               : edge;
  }
  if (some_disc) return discs_.enclosing_pose(disc);
  return some_edge ? edge : bodies_.size();
}

bool is_in_polygon(Vec2 p, const Body& body) {
  return std::visit(
      Overloaded{[](const Disc&) { return false; },
                 [&](const Polygon& polygon) { return locate(polygon, p) != Side::outside; }},
      body.shape);
}

double depth_in(const Body& body, Vec2 p) {
  return std::visit(
      Overloaded{[&](const Disc& disc) { return disc.radius - distance(p, disc.centre); },
                 [&](const Polygon& polygon) { return -signed_distance(p, polygon); }},
      body.shape);
}

}  // namespace microswarm
