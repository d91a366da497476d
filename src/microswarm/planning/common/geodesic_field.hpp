// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// About how far it is to a goal for a point that stays in the free space: Dijkstra over the
/// centres of a grid's cells, eight neighbours each where they see each other. A guide, not a
/// measure: up to 8 % and some cells too long, and passages narrower than a cell may be missing;
/// never through a wall.
class GeodesicField {
 public:
  /// A grid of about `cells` × `cells`.
  GeodesicField(const Map& map, Vec2 goal, int cells = 128);

  /// Distance [µm] at `p`; where no way was found, the straight one and a way around the map.
  double at(Vec2 p) const;
  /// The same by a centre that `p` sees, its cell's or one around that, for points beside a wall
  /// too. `map` is the one the field was made for.
  double seen_from(const Map& map, Vec2 p) const;
  /// Was a way to the goal found from the cell of `p`?
  bool reaches(Vec2 p) const;

 private:
  std::size_t cell_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t index(Vec2 p) const;
  Vec2 centre(std::size_t cell) const;

  Vec2 low_;
  Vec2 goal_;
  double cell_ = 1;
  double detour_ = 0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<float> distances_;
};

}  // namespace microswarm
