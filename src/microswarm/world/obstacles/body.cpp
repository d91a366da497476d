// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/body.hpp"

#include <algorithm>

#include "microswarm/geometry/distance.hpp"

namespace microswarm {

double distance(Vec2 p, const Body& body) {
  return std::visit([&](const auto& shape) { return distance(p, shape); }, body.shape);
}

double distance(Segment s, const Body& body) {
  return std::visit([&](const auto& shape) { return distance(s, shape); }, body.shape);
}

Disc extent_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body.shape)) return *disc;
  const std::vector<Vec2>& outline = *outline_of(body);
  Disc extent{centroid(outline), 0};
  for (const Vec2 v : outline) extent.radius = std::max(extent.radius, distance(extent.centre, v));
  return extent;
}

}  // namespace microswarm
