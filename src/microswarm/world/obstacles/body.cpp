// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/body.hpp"

#include <algorithm>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm {

double distance(Vec2 p, const Body& body) {
  return std::visit([&](const auto& shape) { return distance(p, shape); }, body.shape);
}

double distance(Segment s, const Body& body) {
  return std::visit([&](const auto& shape) { return distance(s, shape); }, body.shape);
}

bool is_disc(const Body& body) {
  return std::visit(
      Overloaded{[](const Disc&) { return true; }, [](const Polygon&) { return false; }},
      body.shape);
}

const std::vector<Vec2>* find_outline(const Body& body) {
  using Outline = const std::vector<Vec2>*;
  return std::visit(Overloaded{[](const Disc&) -> Outline { return nullptr; },
                               [](const Polygon& polygon) -> Outline { return &polygon.outer; }},
                    body.shape);
}

Disc enclosing_disc(const Body& body) {
  return std::visit(Overloaded{[](const Disc& disc) { return disc; },
                               [](const Polygon& polygon) {
                                 Disc extent{centroid(polygon.outer), 0};
                                 for (const Vec2 v : polygon.outer)
                                   extent.radius =
                                       std::max(extent.radius, distance(extent.centre, v));
                                 return extent;
                               }},
                    body.shape);
}

void shift(Body& body, Vec2 by) {
  std::visit(Overloaded{[&](Disc& disc) { disc.centre += by; },
                        [&](Polygon& polygon) {
                          for (Vec2& v : polygon.outer) v += by;
                          for (auto& hole : polygon.holes)
                            for (Vec2& v : hole) v += by;
                        }},
             body.shape);
}

}  // namespace microswarm
