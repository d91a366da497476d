// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/turn_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "microswarm/world/obstacles/clip.hpp"

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

/// The triangles that the turned frame cuts off its upright box, one at each side, as they were
/// before the turn.
template <class TurnBack>
std::vector<Polygon> cut_off(const std::array<Vec2, 4>& frame, const std::array<Vec2, 4>& corners,
                             TurnBack&& turn_back) {
  std::vector<Polygon> triangles;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::size_t next = (i + 1) % frame.size();
    const Vec2 a = corners[i], b = corners[next];
    const Vec2 d = b - a;
    if (d.x * d.y == 0) continue;
    const Vec2 outer = d.x * d.y > 0 ? Vec2{b.x, a.y} : Vec2{a.x, b.y};
    Polygon triangle = normalised({{frame[i], turn_back(outer), frame[next]}, {}});
    if (signed_area(triangle.outer) > 0) triangles.push_back(std::move(triangle));
  }
  return triangles;
}

}  // namespace

double map_turn(double angle, double diagonal) {
  constexpr double quarter = std::numbers::pi / 2;
  constexpr double rounding = 0.01;  // [cells]
  const double quarters = std::round(angle / quarter);
  if (std::abs(angle - quarters * quarter) * diagonal > rounding) return angle;
  return std::fmod(quarters, 4) * quarter;
}

MapParts turned(MapParts parts, Vec2 pivot, double angle) {
  const Vec2 u = turn_direction(angle);
  const auto turn = [&](Vec2 p) {
    const Vec2 d = p - pivot;
    return pivot + Vec2{u.x * d.x - u.y * d.y, u.y * d.x + u.x * d.y};
  };
  const auto turn_back = [&](Vec2 p) {
    const Vec2 d = p - pivot;
    return pivot + Vec2{u.x * d.x + u.y * d.y, u.x * d.y - u.y * d.x};
  };
  const Box upright = parts.bounds;
  const auto [lo, hi] = upright;
  const std::array<Vec2, 4> frame{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  std::array<Vec2, 4> corners{};
  std::ranges::transform(frame, corners.begin(), turn);
  parts.bounds = bounding_box(corners);

  // What is added shares edges with walls at the frame: they are united before the turn, where the
  // edges coincide exactly.
  std::vector<Polygon> at_frame = cut_off(frame, corners, turn_back);
  std::vector<Polygon> walls;
  for (Polygon& wall : parts.walls) {
    const Box box = bounding_box(wall);
    const bool is_inside = box.lo.x > lo.x && box.lo.y > lo.y && box.hi.x < hi.x && box.hi.y < hi.y;
    (is_inside ? walls : at_frame).push_back(std::move(wall));
  }
  for (Polygon& wall : united(at_frame)) walls.push_back(std::move(wall));
  for (Polygon& wall : walls) {
    std::ranges::transform(wall.outer, wall.outer.begin(), turn);
    for (auto& hole : wall.holes) std::ranges::transform(hole, hole.begin(), turn);
  }
  parts.walls = std::move(walls);
  for (Disc& disc : parts.discs) disc.centre = turn(disc.centre);
  return parts;
}

}  // namespace microswarm::formats
