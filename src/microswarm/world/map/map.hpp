// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "microswarm/world/map/clearance_field.hpp"
#include "microswarm/world/obstacles/body_set.hpp"

namespace microswarm {

class Corners;
class KeptWork;

/// Static part of a world: a bounded workspace and its wall pieces. The border counts as a wall.
/// Free means clearance >= r and clearance > 0, for walls and border alike, so for r = 0 a point on
/// a wall or on the border is not free. Immutable after construction, shared by threads.
class Map {
 public:
  Map();
  /// Connected wall pieces are numbered from 0 in the order given (`Body::obstacle`); overlapping
  /// polygons are united. Walls may extend beyond the bounds. `field_cell` [µm] is the cell size of
  /// the clearance field; 0 chooses it. Throws InputError if `bounds` is empty or not finite, a
  /// vertex or a disc is not finite, or a radius is negative.
  Map(const Box& bounds, std::vector<Polygon> walls, const std::vector<Disc>& discs = {},
      double field_cell = 0);

  const Box& bounds() const { return bounds_; }
  const BodySet& walls() const { return walls_; }
  const ClearanceField& field() const { return field_; }
  /// Possible bends of shortest paths, computed by the first call, about 1 µs a corner, and kept.
  const Corners& corners() const;
  /// Cache of algorithms for later queries on this map and its copies.
  KeptWork& kept() const;
  /// Number of connected wall pieces.
  int pieces() const { return pieces_; }

  /// Distance [µm] to the nearest wall or border, 0 in a wall or outside the bounds. Exact.
  double clearance(Vec2 p) const;
  /// The same [µm] without the border; infinity without walls.
  double wall_clearance(Vec2 p) const;
  /// Distance [µm] from the segment to the nearest wall or border, 0 if they meet, at most `limit`.
  /// Exact.
  double clearance(Segment s, double limit) const;
  /// Distance [µm] to the border, 0 outside: D_bd of Eq 4d [drrt].
  double border_clearance(Vec2 p) const;
  /// Whether the disc of radius r around `p` is free of walls and inside the bounds. Exact.
  bool is_free(Vec2 p, double r) const {
    const double lower = field_.lower(p);
    return field_.decides(lower, r) ? lower >= r : is_free_exactly(p, r);
  }
  /// The same for many places at once, which is quicker: free[i] is 1 if places[i] is
  /// free, else 0. `free` is as long as `positions`.
  void are_free(std::span<const Vec2> positions, double r, std::span<std::uint8_t> free) const;
  /// One bit for each of up to 32 places, from the lowest on: 0 if it is not free, 1 if it is or
  /// undecided without `is_free`. Faster than single queries, since there are no branches.
  unsigned may_be_free(std::span<const Vec2> positions, double r) const {
    unsigned bits = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double lower = field_.lower(positions[i]);
      bits |= static_cast<unsigned>((lower >= r) | !field_.decides(lower, r)) << i;
    }
    return bits;
  }
  /// Whether the capsule of radius r around s is free. Exact.
  bool is_free(Segment s, double r) const;

 private:
  bool is_free_exactly(Vec2 p, double r) const;
  double clearance_beyond(Vec2 p, double lower) const;
  double useful_clearance(Vec2 p, double lower, double r, double length) const;
  bool passes_a_wall(Segment s, double length, double least) const;
  double margin(double r) const;
  bool piece_is_free(Segment s, double from_a, double from_b, double r, int halvings) const;

  struct Derived;

  Box bounds_;
  BodySet walls_;
  ClearanceField field_;
  std::shared_ptr<Derived> derived_;  ///< of all copies
  int pieces_ = 0;
};

}  // namespace microswarm
