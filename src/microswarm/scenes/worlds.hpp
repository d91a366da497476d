// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::scenes {

/// A world as plain shapes, for tests that must not rely on the world's own queries.
struct RawWorld {
  std::string name{};
  Box bounds{{0, 0}, {1000, 700}};
  std::vector<Polygon> walls{};
  std::vector<Disc> discs{};
  std::vector<Disc> movers{};
  double field_cell = 5;  ///< coarse: fast to build, and exercises the exact queries

  Snapshot snapshot() const;
  /// Distance [µm] from the segment to the nearest shape or border, by brute force.
  double clearance(Segment s) const;
  double clearance(Vec2 p) const { return clearance(Segment{p, p}); }
};

/// The outline of a box.
Polygon rectangle(Box box);
/// A rectangle rotated by `angle` [rad] about its centre.
Polygon turned_rectangle(Vec2 centre, double width, double height, double angle);

/// Number of kinds of random worlds: scattered discs, boxes, 1 µm thick walls with gaps, winding
/// channels, and all of these with moving discs.
inline constexpr int random_kinds = 5;
RawWorld random_world(int kind, Rng& rng);

/// Random free point of the world by brute force; the bounds' centre if none was found.
Vec2 random_free_point(const RawWorld& world, double clearance, Rng& rng);

/// 2000 × 1000 µm with 140 discs and 70 polygons, which may overlap; `side` times as long and wide,
/// as densely.
RawWorld cluttered(Rng& rng, int side = 1);

}  // namespace microswarm::scenes
