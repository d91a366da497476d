// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/free_place.hpp"

#include <array>
#include <cstddef>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr std::size_t direction_count = 16;

std::array<Vec2, direction_count> evenly_spaced() {
  std::array<Vec2, direction_count> directions;
  for (std::size_t i = 0; i < direction_count; ++i)
    directions[i] = unit_vector(2 * pi * static_cast<double>(i) / direction_count);
  return directions;
}

}  // namespace

Vec2 free_place(const Map& map, Vec2 position, double r) {
  if (map.is_free(position, r)) return position;
  static const auto directions = evenly_spaced();
  const Vec2 size = map.bounds().hi - map.bounds().lo;
  const double farthest = norm(size) + distance(position, map.bounds().centre());
  for (double away = 2 * r; away < farthest; away *= 1.25)
    for (const Vec2 direction : directions) {
      const Vec2 p = position + away * direction;
      if (map.is_free(p, r)) return p;
    }
  return position;
}

}  // namespace microswarm
