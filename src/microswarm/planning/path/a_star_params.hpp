// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// A* on an 8-connected grid whose origin is the start. It cuts no corners and checks every edge
/// with the clearance. The path is the shortest on its grid to any cell within the goal tolerance.
/// If the goal lies between cells, a tolerance below cell / √2 may contain no cell.
struct AStarParams {
  static constexpr std::string_view type_name = "a_star";
  double clearance = 40;
  double goal_tolerance = 50;
  double cell = 20;
  int max_nodes = 4'000'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, {"clearance", Unit::um, {0, 1e6}, "Minimum distance to walls."});
    visit(self.goal_tolerance,
          {"goal_tolerance", Unit::um, {0, 1e6}, "Distance at which the goal counts as reached."});
    visit(self.cell, {"cell", Unit::um, {1e-3, 1e6}, "Grid spacing."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 1e8}, "Maximum number of opened cells."});
  }
};

}  // namespace microswarm
