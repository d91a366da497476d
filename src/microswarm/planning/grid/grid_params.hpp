// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::planning {

/// Parameters common to the planners on an 8-connected grid. They cut no corners and check every
/// edge with the clearance. If the grid has no path, its spacing is halved, until a path is found,
/// `exact` proves that there is none, or the nodes run out. The grid's origin is the start, unless
/// another is set: then start and goal are joined to the cells around them. Without one, if the
/// goal lies between cells, a tolerance below cell / √2 may contain no cell.
struct GridParams {
  double clearance = 40;
  double goal_tolerance = 50;
  double cell = 20;
  std::optional<Vec2> origin{};
  int max_nodes = 4'000'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, um("clearance", 0, 1e6, "Minimum distance to walls."));
    visit(self.goal_tolerance,
          um("goal_tolerance", 0, 1e6, "Distance at which the goal counts as reached."));
    visit(self.cell, um("cell", 1e-3, 1e6, "Grid spacing to begin with."));
    visit(self.origin, um("origin", -1e6, 1e6, "A cell of the grid; unset: the start."));
    visit(self.max_nodes, plain("max_nodes", 1, 1e8, "Maximum number of opened cells."));
  }
};

/// A*: the path is the shortest on its grid to any cell within the goal tolerance.
struct AStarParams : GridParams {
  static constexpr std::string_view type_name = "a_star";
};

/// Lazy Theta* (Nash, Koenig and Tovey 2010): the path takes any angle, from cell to cell, and is
/// usually within some percent of the shortest.
struct ThetaStarParams : GridParams {
  static constexpr std::string_view type_name = "theta_star";
};

}  // namespace microswarm::planning
