// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/shapes.hpp"
#include "microswarm/geometry/uniform_in.hpp"

namespace microswarm {

inline Vec2 random_point(Rng& rng, const Box& box) { return uniform_in(box, rng); }

/// A point on a coarse lattice, so that coincidences and collinear triples are common.
inline Vec2 lattice_point(Rng& rng, std::uint64_t n) {
  return {static_cast<double>(rng.below(n)), static_cast<double>(rng.below(n))};
}

/// Star-shaped polygon of 3 to 12 corners; some are needles.
inline std::vector<Vec2> random_star(Rng& rng, Vec2 centre, double radius) {
  const std::size_t n = 3 + rng.below(10);
  const double thin = rng.below(4) == 0 ? 1e-4 : 1.0;
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = (static_cast<double>(i) + 0.8 * rng.uniform()) / static_cast<double>(n);
    const Vec2 u = unit_vector(6.283185307179586 * angle);
    ring.push_back(centre + radius * rng.uniform(0.2, 1.0) * Vec2{u.x, thin * u.y});
  }
  return ring;
}

/// Closed rings around the dark pixels of a random mask, solid on the left, one edge a pixel side:
/// full of collinear corners, and rings that touch in corners.
inline std::vector<Segment> traced_pixels(const std::set<std::pair<int, int>>& dark, double pixel,
                                          Vec2 origin) {
  std::vector<Segment> edges;
  auto corner = [&](int x, int y) { return origin + pixel * Vec2{double(x), double(y)}; };
  for (const auto& [x, y] : dark) {
    if (!dark.contains({x, y - 1})) edges.push_back({corner(x, y), corner(x + 1, y)});
    if (!dark.contains({x + 1, y})) edges.push_back({corner(x + 1, y), corner(x + 1, y + 1)});
    if (!dark.contains({x, y + 1})) edges.push_back({corner(x + 1, y + 1), corner(x, y + 1)});
    if (!dark.contains({x - 1, y})) edges.push_back({corner(x, y + 1), corner(x, y)});
  }
  return edges;
}

inline std::set<std::pair<int, int>> random_pixels(Rng& rng, int size, double share) {
  std::set<std::pair<int, int>> dark;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (rng.uniform() < share) dark.emplace(x, y);
    }
  }
  return dark;
}

inline std::vector<Segment> edges_of(const std::vector<Polygon>& polygons) {
  std::vector<Segment> edges;
  for (const Polygon& polygon : polygons) {
    for_each_edge(polygon, [&](Vec2 a, Vec2 b) { edges.push_back({a, b}); });
  }
  return edges;
}

}  // namespace microswarm
