// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/neck.hpp"

#include <algorithm>
#include <vector>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm {
namespace {

constexpr int max_steps = 50;

/// Wall edge or disc: all points within `radius` of the core.
struct Feature {
  Segment core;
  double radius;
};

Vec2 nearest_point(Vec2 p, const Feature& f) {
  const Vec2 q = microswarm::nearest_point(p, f.core);
  const double d = distance(p, q);
  return d > 0 ? q + std::min(1.0, f.radius / d) * (p - q) : q;
}

std::vector<Feature> features_near(const Map& map, Vec2 position, double reach) {
  std::vector<Feature> out;
  auto add = [&](const Feature& f) {
    if (distance(position, nearest_point(position, f)) <= reach) out.push_back(f);
  };
  for (const Body& body : map.walls().bodies()) {
    std::visit(Overloaded{[&](const Disc& disc) {
                            add({{disc.centre, disc.centre}, disc.radius});
                          },
                          [&](const Polygon& polygon) {
                            for_each_edge(polygon, [&](Vec2 a, Vec2 b) { add({{a, b}, 0}); });
                          }},
               body.shape);
  }
  const Box& b = map.bounds();
  const Vec2 corners[] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
  for (int k = 0; k < 4; ++k) add({{corners[k], corners[(k + 1) % 4]}, 0});
  return out;
}

/// Shortest connection of two convex sets near `p`, by alternating projections of its midpoint.
Segment connection(const Feature& f, const Feature& g, Vec2 p) {
  Segment s{nearest_point(p, f), nearest_point(p, g)};
  for (int k = 0; k < max_steps; ++k) {
    const Vec2 middle = 0.5 * (s.a + s.b);
    const Segment next{nearest_point(middle, f), nearest_point(middle, g)};
    if (next.a == s.a && next.b == s.b) break;
    s = next;
  }
  return s;
}

}  // namespace

Passage neck_near(const Map& map, Vec2 position, double least, double spacing) {
  const std::vector<Feature> features = features_near(map, position, least + 3 * spacing);
  Passage best{position, 2 * least};
  double min_offset = 4 * spacing;
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 to_i = nearest_point(position, features[i]) - position;
      const Vec2 to_j = nearest_point(position, features[j]) - position;
      if (dot(to_i, to_j) >= 0) continue;
      const Segment s = connection(features[i], features[j], position);
      const Vec2 middle = 0.5 * (s.a + s.b);
      const double half = 0.5 * distance(s.a, s.b);
      if (half < least * (1 - 1e-9) || half > least + 1.5 * spacing) continue;
      const double offset = distance(middle, position);
      if (offset >= min_offset || map.clearance(middle) < half * (1 - 1e-9)) continue;
      best = {middle, 2 * half};
      min_offset = offset;
    }
  }
  return best;
}

}  // namespace microswarm
