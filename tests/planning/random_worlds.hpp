// SPDX-License-Identifier: Apache-2.0
// Worlds of obstacles that stand apart, touch and overlap.
#pragma once

#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

inline constexpr double size = 100;

/// A polygon, convex or not.
inline Polygon random_polygon(Rng& rng) {
  const Vec2 centre{rng.uniform(0, size), rng.uniform(0, size)};
  const std::size_t n = 3 + rng.below(5);
  const double radius = rng.uniform(4, 18);
  Polygon polygon;
  for (std::size_t k = 0; k < n; ++k)
    polygon.outer.push_back(
        centre + rng.uniform(0.3, 1) * radius *
                     unit_vector(2 * pi * (static_cast<double>(k) + 0.5 * rng.uniform()) /
                                 static_cast<double>(n)));
  return polygon;
}

inline Disc random_disc(Rng& rng) {
  return {{rng.uniform(0, size), rng.uniform(0, size)}, rng.uniform(1, 10)};
}

/// Polygons, and discs that stand apart, overlap and touch walls.
inline Map random_map(Rng& rng) {
  std::vector<Polygon> walls;
  std::vector<Disc> discs;
  const std::uint64_t count = 2 + rng.below(5) + 14 * (rng.below(4) == 0);
  for (std::uint64_t i = 0; i < count; ++i) walls.push_back(random_polygon(rng));
  for (std::uint64_t i = 0; i < rng.below(7); ++i) discs.push_back(random_disc(rng));
  return Map({{0, 0}, {size, size}}, walls, discs);
}

/// Small polygons all over, so that paths go by many corners.
inline Map crowded_map(Rng& rng) {
  std::vector<Polygon> walls;
  for (int i = 0; i < 30; ++i) {
    Polygon wall = random_polygon(rng);
    const Vec2 at{rng.uniform(0, size), rng.uniform(0, size)};
    const Vec2 first = wall.outer.front();
    for (Vec2& v : wall.outer) v = at + 0.5 * (v - first);
    walls.push_back(wall);
  }
  return Map({{0, 0}, {size, size}}, walls);
}

/// Discs of many sizes and up to two polygons, wherever they may be.
inline std::vector<Body> random_bodies(Rng& rng) {
  std::vector<Body> bodies;
  for (std::uint64_t i = 0, n = rng.below(12); i < n; ++i) {
    Disc disc = random_disc(rng);
    disc.radius *= rng.uniform(0.05, 1);
    bodies.push_back({disc, 0});
  }
  for (std::uint64_t i = 0, n = rng.below(3); i < n; ++i)
    bodies.push_back({random_polygon(rng), 0});
  return bodies;
}

}  // namespace microswarm::planning
