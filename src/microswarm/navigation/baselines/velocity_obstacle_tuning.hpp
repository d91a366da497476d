// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of VelocityObstacleNavigator that rarely need a change.
struct VelocityObstacleTuning {
  double growth_time = 1;
  double route_reach = 400;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.growth_time,
          s("growth_time", 0, 60, "Time for which polygons keep deforming as observed."));
    visit(self.route_reach, um("route_reach", 1e-2, 1e6, "Distance looked ahead along the route."));
  }
};

}  // namespace microswarm::navigation
