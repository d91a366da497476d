// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// The simplest baseline: straight at the goal, and stop while something stands in the way.
struct StraightParams {
  static constexpr std::string_view type_name = "straight_stop";
  double speed = 60;
  double stop_distance = 100;
  double gap = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Speed asked for."});
    visit(self.stop_distance,
          {"stop_distance",
           Unit::um,
           {0, 1e5},
           "Stop while a wall or an obstacle is so near ahead, from edge to edge."});
    visit(self.gap, {"margin", Unit::um, {0, 1e5}, "Kept beside the swarm's edge."});
  }
};

}  // namespace microswarm
