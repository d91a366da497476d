// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "microswarm/world/body_set.hpp"
#include "microswarm/world/clearance_field.hpp"

namespace microswarm {

/// The part of a world that never moves: a bounded workspace and its wall pieces. The border is a
/// wall too: the swarm keeps its clearance from it. Immutable after building, shared by threads.
class Map {
 public:
  Map() = default;
  /// Overlapping walls are united, so that each connected wall piece is one body. Throws InputError
  /// when `bounds` is empty or not finite or a vertex is not finite.
  Map(const Box& bounds, std::vector<Polygon> walls, std::vector<Disc> discs = {},
      double field_cell = 0);

  const Box& bounds() const { return bounds_; }
  const BodySet& walls() const { return walls_; }
  const ClearanceField& field() const { return field_; }

  /// Distance [µm] to the nearest wall or border, 0 in a wall or outside the bounds. Exact.
  double clearance(Vec2 p) const;
  /// Distance [µm] to the border, 0 outside: D_bd of Eq 4d [drrt].
  double border_clearance(Vec2 p) const;
  /// Is the disc of radius r around `p` free of walls and inside the bounds? Exact.
  bool is_free(Vec2 p, double r) const;
  /// Is the capsule of radius r around s free? Exact.
  bool is_free(Segment s, double r) const;

 private:
  Box bounds_;
  BodySet walls_;
  ClearanceField field_;
};

}  // namespace microswarm
