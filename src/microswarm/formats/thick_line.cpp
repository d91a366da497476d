// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/thick_line.hpp"

#include <optional>

namespace microswarm::formats {

void add_thick_line(MapParts& parts, std::span<const Vec2> points, double width) {
  const double half = width / 2;
  std::optional<Vec2> last;
  for (const Vec2 p : points) {
    if (last && distance(*last, p) < min_line_width) continue;  // within the disc there
    parts.discs.push_back({p, half});
    if (last) {
      const Vec2 along = p - *last;
      const Vec2 aside = half / norm(along) * Vec2{-along.y, along.x};
      parts.walls.push_back({{*last - aside, p - aside, p + aside, *last + aside}, {}});
    }
    last = p;
  }
}

}  // namespace microswarm::formats
