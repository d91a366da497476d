// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/polygon_set.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

constexpr std::size_t few_edges = 64;

/// Enlarged beyond rounding errors, so that it contains the polygon.
Disc bounding_circle(std::span<const Vec2> ring) {
  const Vec2 centre = bounding_box(ring).centre();
  double squared = 0;
  for (const Vec2 p : ring) squared = std::max(squared, squared_norm(p - centre));
  const double magnitude = std::abs(centre.x) + std::abs(centre.y);
  return {centre, std::sqrt(squared) * (1 + 1e-12) + 1e-14 * magnitude};
}

int winding_around(std::span<const Segment> edges, Vec2 p) {
  int sum = 0;
  for (const Segment& e : edges) sum += winding_of_edge(e.a, e.b, p);
  return sum;
}

bool beyond(const Disc& circle, Vec2 p, double reach) {
  const double r = circle.radius + reach;
  return squared_norm(p - circle.centre) > r * r;
}

}  // namespace

void PolygonSet::assign(std::span<const Body> bodies) {
  rounds_.clear();
  edges_.clear();
  bodies_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto add = [&](const Polygon& polygon) {
      if (polygon.outer.size() < 3) return;
      const auto body = static_cast<std::uint32_t>(i);
      rounds_.push_back(
          {bounding_circle(polygon.outer), static_cast<std::uint32_t>(edges_.size()), body});
      for_each_edge(polygon, [&](Vec2 a, Vec2 b) { edges_.push_back({a, b}); });
      bodies_.resize(edges_.size(), body);
    };
    std::visit(Overloaded{[](const Disc&) {}, add}, bodies[i].shape);
  }
  if (edges_.size() > few_edges) {
    grid_.assign(edges_, bodies_);
  } else if (!grid_.empty()) {
    grid_.assign({}, {});
  }
}

bool PolygonSet::holds(Vec2 p) const {
  if (!grid_.empty()) return grid_.in_solid(p);
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    if (beyond(rounds_[k].circle, p, 0)) continue;
    const auto edges = edges_at(k);
    if (std::any_of(edges.begin(), edges.end(), [&](const Segment& e) { return contains(e, p); }) ||
        winding_around(edges, p) != 0) {
      return true;
    }
  }
  return false;
}

int PolygonSet::winding(Vec2 p) const {
  return grid_.empty() ? winding_around(edges_, p) : grid_.winding(p);
}

double PolygonSet::edge_distance(Vec2 p, double limit) const {
  if (!grid_.empty()) return grid_.distance(p, limit);
  double best = limit * limit;
  double reach = limit;
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    if (beyond(rounds_[k].circle, p, reach)) continue;
    for (const Segment& e : edges_at(k)) best = std::min(best, squared_distance(p, e));
    reach = std::min(limit, std::sqrt(best));
  }
  return reach;
}

double PolygonSet::edge_distance(Segment s, double limit) const {
  if (!grid_.empty()) return grid_.distance(s, limit);
  const Vec2 middle = 0.5 * (s.a + s.b);
  const double half = 0.5 * distance(s.a, s.b) * (1 + 1e-12);
  double best = limit * limit;
  double reach = limit;
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    if (beyond(rounds_[k].circle, middle, half + reach)) continue;
    for (const Segment& e : edges_at(k)) best = std::min(best, squared_distance(s, e));
    reach = std::min(limit, std::sqrt(best));
  }
  return reach;
}

bool PolygonSet::edges_free(Segment s, double r) const {
  if (!grid_.empty()) return grid_.capsule_free(s, r);
  const Vec2 middle = 0.5 * (s.a + s.b);
  const double half = 0.5 * distance(s.a, s.b) * (1 + 1e-12);
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    if (beyond(rounds_[k].circle, middle, half + r)) continue;
    for (const Segment& e : edges_at(k)) {
      if (r > 0 ? squared_distance(s, e) < r * r : intersects(s, e)) return false;
    }
  }
  return true;
}

std::uint32_t PolygonSet::nearest(Vec2 p, double limit) const {
  if (!grid_.empty()) {
    const std::size_t edge = grid_.nearest(p, limit);
    return edge == grid_.size() ? none : grid_.enclosing_pose(edge);
  }
  double best = limit * limit;
  std::uint32_t found = none;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const double d = squared_distance(p, edges_[i]);
    if (d < best || (d == best && found == none)) {
      best = d;
      found = bodies_[i];
    }
  }
  return found;
}

}  // namespace microswarm
