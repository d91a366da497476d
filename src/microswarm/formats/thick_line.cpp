// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/thick_line.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "microswarm/geometry/distance.hpp"

namespace microswarm::formats {
namespace {

/// The points without those that are at most `tolerance` [µm] from the line through the others.
std::vector<Vec2> thinned(std::span<const Vec2> points, double tolerance) {
  constexpr std::size_t window = 64;  // limits the points that are looked at again for each
  std::vector<Vec2> kept{points[0]};
  for (std::size_t from = 0; from + 1 < points.size();) {
    const auto is_straight = [&](std::size_t to) {
      const auto between = points.subspan(from + 1, to - from - 1);
      return std::ranges::all_of(between, [&](Vec2 p) {
        return distance(p, Segment{points[from], points[to]}) <= tolerance;
      });
    };
    std::size_t to = from + 1;
    while (to + 1 < points.size() && to - from < window && is_straight(to + 1)) ++to;
    kept.push_back(points[to]);
    from = to;
  }
  return kept;
}

}  // namespace

void add_thick_line(MapParts& parts, std::span<const Vec2> points, double width) {
  if (points.empty()) return;
  const double half = width / 2;
  const std::vector<Vec2> line = thinned(points, thick_line_rounding * width);
  Vec2 last = line[0];
  parts.discs.push_back({last, half});
  for (const Vec2 p : std::span(line).subspan(1)) {
    if (distance(last, p) < min_line_width) continue;  // within the disc there
    const Vec2 along = p - last;
    const Vec2 aside = half / norm(along) * Vec2{-along.y, along.x};
    parts.discs.push_back({p, half});
    parts.walls.push_back({{last - aside, p - aside, p + aside, last + aside}, {}});
    last = p;
  }
}

}  // namespace microswarm::formats
