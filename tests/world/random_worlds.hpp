// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

inline Vec2 random_point(Rng& rng, const Box& box) { return uniform_in(box, rng); }

/// Star-shaped polygon of 3 to 12 corners; `thin` flattens it, down to a needle.
inline Polygon random_star(Rng& rng, Vec2 centre, double radius, double thin = 1) {
  const int n = 3 + static_cast<int>(rng.below(10));
  const double turned = rng.uniform(-pi, pi);
  Polygon out;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * (i + 0.8 * rng.uniform()) / n;
    const Vec2 spoke = rng.uniform(0.3, 1.0) * radius * unit_vector(angle);
    out.outer.push_back(centre + rotated({spoke.x, thin * spoke.y}, turned));
  }
  return out;
}

inline Polygon rectangle(double left, double bottom, double right, double top) {
  return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, {}};
}

/// Walls as they were drawn, before a map unites them, and the plain definitions on them.
struct Drawn {
  Box bounds{{0, 0}, {2000, 1000}};
  std::vector<Polygon> polygons;
  std::vector<Disc> discs;

  Map map(double cell = 0) const { return Map(bounds, polygons, discs, cell); }

  double border(Vec2 p) const {
    return std::max(0.0, std::min({p.x - bounds.lo.x, bounds.hi.x - p.x, p.y - bounds.lo.y,
                                   bounds.hi.y - p.y}));
  }
  template <class Shape>  // Vec2 or Segment
  double to_walls(Shape s) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Polygon& p : polygons) least = std::min(least, distance(s, p));
    for (const Disc& d : discs) least = std::min(least, distance(s, d));
    return least;
  }
  double clearance(Vec2 p) const { return std::min(border(p), to_walls(p)); }
  double clearance(Segment s) const { return std::min({border(s.a), border(s.b), to_walls(s)}); }
};

inline bool is_free_at(double clearance, double r) { return clearance >= r && clearance > 0; }

/// Stars and discs that overlap at will; every fourth star is a needle.
inline Drawn crowded(Rng& rng, int stars, int discs) {
  Drawn out;
  for (int i = 0; i < stars; ++i) {
    const double thin = i % 4 == 0 ? std::pow(10.0, rng.uniform(-5, -1)) : 1;
    out.polygons.push_back(
        random_star(rng, random_point(rng, out.bounds), rng.uniform(10, 120), thin));
  }
  for (int i = 0; i < discs; ++i) {
    out.discs.push_back({random_point(rng, out.bounds), rng.uniform(1, 40)});
  }
  return out;
}

/// One star or disc in each cell of a raster, so that nothing touches and nothing is united.
inline Drawn orchard(Rng& rng, int columns, int rows) {
  Drawn out;
  const Vec2 cell{out.bounds.width() / columns, out.bounds.height() / rows};
  const double radius = 0.45 * std::min(cell.x, cell.y);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec2 centre{(i + 0.5) * cell.x, (j + 0.5) * cell.y};
      if (rng.below(3) == 0) {
        out.discs.push_back({centre, rng.uniform(0.1, 1.0) * radius});
      } else {
        out.polygons.push_back(random_star(rng, centre, radius, rng.below(4) == 0 ? 0.01 : 1.0));
      }
    }
  }
  return out;
}

}  // namespace microswarm
