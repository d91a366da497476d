// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/valve_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::rig {
namespace {

struct Extents {
  Range along{infinity, -infinity};
  Range across{infinity, -infinity};
};

/// Extents of a body seen from `at`, along a unit vector and across it.
Extents extents_from(Vec2 at, Vec2 along, const Body& body) {
  Extents e;
  const auto include = [&](Vec2 p, double radius) {
    const Vec2 q{dot(p - at, along), cross(along, p - at)};
    e.along = {std::min(e.along.min, q.x - radius), std::max(e.along.max, q.x + radius)};
    e.across = {std::min(e.across.min, q.y - radius), std::max(e.across.max, q.y + radius)};
  };
  std::visit(Overloaded{[&](const Disc& disc) { include(disc.centre, disc.radius); },
                        [&](const Polygon& polygon) {
                          for (const Vec2 v : polygon.outer) include(v, 0);
                        }},
             body.shape);
  return e;
}

/// The part of a convex ring to the left of the line through `at` along a unit vector.
std::vector<Vec2> left_part(const std::vector<Vec2>& ring, Vec2 at, Vec2 along) {
  std::vector<Vec2> part;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i];
    const Vec2 q = ring[(i + 1) % ring.size()];
    const double from = cross(along, p - at);
    const double to = cross(along, q - at);
    if (from >= 0) part.push_back(p);
    if (from * to < 0) part.push_back(p + from / (from - to) * (q - p));
  }
  return part;
}

}  // namespace

ValveLeaves::ValveLeaves(std::span<const Obstacle> obstacles, double tolerance)
    : tolerance_(tolerance) {
  for (const Obstacle& obstacle : obstacles) {
    const auto* valve = std::get_if<Valve>(&obstacle.shape);
    const auto* still = std::get_if<Still>(&obstacle.motion);
    if (valve && still)
      valves_.push_back({.at = still->position,
                         .along = unit_vector(still->heading),
                         .half_thickness = valve->thickness / 2,
                         .half_span = valve->span / 2});
  }
}

void ValveLeaves::join(std::vector<Body>& bodies) const {
  for (std::uint32_t k = 0; k < count(); ++k) join(valves_[k], k, bodies);
}

void ValveLeaves::join(const Standing& valve, std::uint32_t number,
                       std::vector<Body>& bodies) const {
  std::vector<std::size_t> left, right, both;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto [along, across] = extents_from(valve.at, valve.along, bodies[i]);
    if (std::max(-along.min, along.max) > valve.half_thickness + tolerance_) continue;
    if (std::max(-across.min, across.max) > valve.half_span + tolerance_) continue;
    const bool is_across = across.min < -tolerance_ && across.max > tolerance_;
    (is_across ? both : across.min + across.max > 0 ? left : right).push_back(i);
  }
  std::vector<Body> leaves;
  if (both.size() == 1 && left.empty() && right.empty()) {
    const auto* ring = find_outline(bodies[both[0]]);
    if (!ring) return;
    leaves = {{.shape = Polygon{left_part(*ring, valve.at, valve.along), {}}, .obstacle = number},
              {.shape = Polygon{left_part(*ring, valve.at, -valve.along), {}}, .obstacle = number}};
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(both[0]));
  } else if (both.empty() && left.size() == 1 && right.size() == 1) {
    leaves = {{.shape = bodies[left[0]].shape, .obstacle = number},
              {.shape = bodies[right[0]].shape, .obstacle = number}};
    for (const std::size_t i : {std::max(left[0], right[0]), std::min(left[0], right[0])})
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::move(leaves.begin(), leaves.end(), std::back_inserter(bodies));
}

}  // namespace microswarm::rig
