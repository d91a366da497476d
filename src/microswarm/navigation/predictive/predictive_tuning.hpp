// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/convex_outline_tuning.hpp"

namespace microswarm::navigation {

/// Constants of PredictiveNavigator that rarely need a change.
struct PredictiveTuning {
  double wall_contact_cost = 200;
  double wall_proximity_cost = 1.5;
  double wall_reach = 20;
  double unreachable_time = 1000;
  double goal_share = 0.9;
  double slow_share = 0.1;
  double closing_time = 1;
  std::vector<double> speed_shares{1, 0.5, 0.25};
  ConvexOutlineTuning outline{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.wall_contact_cost,
          plain("wall_contact_cost", 0, 1e6, "Cost rate in contact with a wall."));
    visit(self.wall_proximity_cost,
          plain("wall_proximity_cost", 0, 1e6,
                "Cost rate at the wall gap; falls to 0 at `wall_reach`."));
    visit(self.wall_reach,
          um("wall_reach", 1e-3, 1e5, "Distance beyond the wall gap without cost."));
    visit(self.unreachable_time,
          s("unreachable_time", 1, 1e6, "Cost of a position without a path to the goal."));
    visit(self.goal_share,
          plain("goal_share", 0, 1, "Share of the tolerance in which the goal is reached."));
    visit(self.slow_share,
          plain("slow_share", 0, 1, "Relative speed below which an obstacle is slow."));
    visit(self.closing_time,
          s("closing_time", 0, 60, "Time for which a non-convex obstacle closes in."));
    visit(self.speed_shares,
          plain("speed_shares", 1e-3, 1, "Shares of the speed tried; the last to turn in place."));
    visit(self.outline, plain("outline", "Use of convex hulls of obstacles."));
  }
};

}  // namespace microswarm::navigation
