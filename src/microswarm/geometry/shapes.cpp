// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/shapes.hpp"

#include <utility>

namespace microswarm {
namespace {

void remove_repeats(std::vector<Vec2>& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
}

void turn(std::vector<Vec2>& ring, bool counter_clockwise) {
  if ((signed_area(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
}

}  // namespace

Box bounding_box(std::span<const Vec2> points) {
  Box box;
  for (const Vec2 p : points) box.include(p);
  return box;
}

Box bounding_box(const Polygon& polygon) { return bounding_box(polygon.outer); }

double signed_area(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    twice += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return 0.5 * twice;
}

Vec2 centroid(std::span<const Vec2> ring) {
  const Vec2 origin = ring.front();
  Vec2 sum;
  double twice_area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - origin;
    const Vec2 b = ring[(i + 1) % ring.size()] - origin;
    sum += cross(a, b) * (a + b);
    twice_area += cross(a, b);
  }
  if (twice_area == 0) return bounding_box(ring).centre();
  return origin + sum / (3 * twice_area);
}

double area(const Polygon& polygon) {
  double sum = std::abs(signed_area(polygon.outer));
  for (const auto& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  return sum;
}

Polygon normalised(Polygon polygon) {
  remove_repeats(polygon.outer);
  if (polygon.outer.size() < 3) return {};
  turn(polygon.outer, true);
  for (auto& hole : polygon.holes) {
    remove_repeats(hole);
    turn(hole, false);
  }
  std::erase_if(polygon.holes, [](const auto& hole) { return hole.size() < 3; });
  return polygon;
}

}  // namespace microswarm
