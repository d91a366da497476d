// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::planning {

/// Parameters of the exact planner: the shortest path, or the proof that there is none. The path
/// consists of tangents between circles of the clearance around corners and discs, and of arcs.
struct ExactParams {
  static constexpr std::string_view type_name = "exact";
  double clearance = 40;
  double goal_tolerance = 50;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, um("clearance", 0, 1e6, "Minimum distance to walls."));
    visit(self.goal_tolerance,
          um("goal_tolerance", 0, 1e6, "Distance at which the goal counts as reached."));
  }
};

}  // namespace microswarm::planning
