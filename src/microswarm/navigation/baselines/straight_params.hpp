// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Simplest baseline: goes straight to the goal and stops while something is in the way.
struct StraightParams {
  static constexpr std::string_view type_name = "straight_stop";
  double speed = 60;
  double stop_distance = 100;
  double gap = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.stop_distance,
          um("stop_distance", 0, 1e5, "Gap ahead, to a wall or an obstacle, at which it stops."));
    visit(self.gap,
          um("gap", 0, 1e5, "Gap kept on both sides of the swarm.").formerly("margin_um"));
  }
};

}  // namespace microswarm::navigation
