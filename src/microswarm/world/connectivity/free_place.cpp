// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/free_place.hpp"

#include "microswarm/core/angles.hpp"

namespace microswarm {

Vec2 free_place(const Map& map, Vec2 place, double r) {
  if (map.is_free(place, r)) return place;
  constexpr int directions = 16;
  const Vec2 size = map.bounds().hi - map.bounds().lo;
  const double farthest = norm(size) + distance(place, map.bounds().centre());
  for (double away = 2 * r; away < farthest; away *= 1.25)
    for (int i = 0; i < directions; ++i) {
      const Vec2 p = place + away * unit_vector(2 * pi * i / directions);
      if (map.is_free(p, r)) return p;
    }
  return place;
}

}  // namespace microswarm
