// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of PotentialFieldNavigator that rarely need a change.
struct PotentialFieldTuning {
  double max_proximity = 20;
  double stencil = 5;
  double rest_speed = 2;
  double command_time = 0.2;
  double route_reach = 400;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.max_proximity,
          plain("max_proximity", 1, 1e6, "Upper bound of influence / gap in the repulsion."));
    visit(self.stencil, um("stencil", 1e-3, 1e3, "Step of the gradient of the walls' repulsion."));
    visit(self.rest_speed, um_per_s("rest_speed", 0, 1e4, "Speed below which an obstacle rests."));
    visit(self.command_time,
          s("command_time", 1e-3, 10, "Time for which a command must be free of walls."));
    visit(self.route_reach, um("route_reach", 1e-2, 1e6, "Distance looked ahead along the route."));
  }
};

}  // namespace microswarm::navigation
