// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// The way to the goal from everywhere in the static map: a grid of shortest distances that keep a
/// clearance, grown once from the goal (Dijkstra, 8 neighbours, every step checked exactly). It
/// gives local target selection the direction in which the goal lies along free space, where the
/// straight direction of Eq 4e [drrt] leads into a dead end.
class Route {
 public:
  Route() = default;
  /// `cell` [µm] is the grid spacing; at most `max_cells` cells are made, by a coarser grid if
  /// need be.
  Route(const Map& map, Vec2 goal, double clearance, double cell,
        std::size_t max_cells = 1'000'000);

  /// Way to go from `p` [µm]; infinity when no way is known.
  double way_from(Vec2 p) const;
  /// Point of the way from `p` at most `reach` µm ahead that the straight line from `p` reaches
  /// with clearance `r`; `p` itself when no way is known.
  Vec2 ahead(const Map& map, Vec2 p, double reach, double r) const;

 private:
  std::size_t cell_at(Vec2 p) const;
  Vec2 centre(std::size_t cell) const;

  Vec2 goal_;
  Vec2 origin_;
  double cell_ = 1;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> way_;
  std::vector<std::uint32_t> next_;
};

}  // namespace microswarm
