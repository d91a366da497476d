// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// The shortest path there is, or the proof that there is none: tangents between circles of the
/// clearance around the corners of walls and around discs, joined by arcs. It needs no tuning.
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

}  // namespace microswarm
