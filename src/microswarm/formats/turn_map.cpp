// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/turn_map.hpp"

#include <array>
#include <cmath>

namespace microswarm::formats {
namespace {

/// Unit vector of the angle, exact for quarters of a turn.
Vec2 turn_direction(double angle) {
  constexpr double rounding = 1e-12;
  Vec2 u = unit_vector(angle);
  if (std::abs(u.x) < rounding) u = {0, std::copysign(1, u.y)};
  if (std::abs(u.y) < rounding) u = {std::copysign(1, u.x), 0};
  return u;
}

}  // namespace

MapParts turned(MapParts parts, Vec2 pivot, double angle) {
  const Vec2 u = turn_direction(angle);
  const auto turn = [&](Vec2& p) {
    const Vec2 d = p - pivot;
    p = pivot + Vec2{u.x * d.x - u.y * d.y, u.y * d.x + u.x * d.y};
  };
  for (Polygon& wall : parts.walls) {
    for (Vec2& p : wall.outer) turn(p);
    for (auto& hole : wall.holes)
      for (Vec2& p : hole) turn(p);
  }
  for (Disc& disc : parts.discs) turn(disc.centre);

  const auto [lo, hi] = parts.bounds;
  std::array<Vec2, 4> frame{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  for (Vec2& p : frame) turn(p);
  parts.bounds = bounding_box(frame);
  // Each side of the frame cuts off a triangle of the box.
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec2 a = frame[i], b = frame[(i + 1) % frame.size()];
    const Vec2 d = b - a;
    const Vec2 corner = d.x * d.y > 0 ? Vec2{b.x, a.y} : Vec2{a.x, b.y};
    Polygon triangle = normalised({{a, corner, b}, {}});
    if (triangle.outer.size() == 3 && signed_area(triangle.outer) > 0)
      parts.walls.push_back(std::move(triangle));
  }
  return parts;
}

}  // namespace microswarm::formats
