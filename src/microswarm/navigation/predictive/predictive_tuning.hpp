// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/convex_outline_tuning.hpp"

namespace microswarm {

/// Constants of PredictiveNavigator that seldom need a change.
struct PredictiveTuning {
  double wall_contact_cost = 200;
  double wall_proximity_cost = 1.5;
  double wall_reach = 20;
  double unreachable_time = 1000;
  double goal_share = 0.9;
  double slow_share = 0.1;
  double closing_time = 1;
  std::vector<double> speed_shares{1, 0.5, 0.25};
  ConvexOutlineTuning outline;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.wall_contact_cost,
          {"wall_contact_cost", Unit::none, {0, 1e6}, "Cost rate in contact with a wall."});
    visit(self.wall_proximity_cost, {"wall_proximity_cost",
                                     Unit::none,
                                     {0, 1e6},
                                     "Cost rate at the wall gap; falls to 0 at `wall_reach`."});
    visit(self.wall_reach,
          {"wall_reach", Unit::um, {1e-3, 1e5}, "Distance beyond the wall gap without cost."});
    visit(
        self.unreachable_time,
        {"unreachable_time", Unit::s, {1, 1e6}, "Cost of a position without a path to the goal."});
    visit(
        self.goal_share,
        {"goal_share", Unit::none, {0, 1}, "Share of the tolerance in which the goal is reached."});
    visit(self.slow_share,
          {"slow_share", Unit::none, {0, 1}, "Relative speed below which an obstacle is slow."});
    visit(self.closing_time,
          {"closing_time", Unit::s, {0, 60}, "Time for which a non-convex obstacle closes in."});
    visit(self.speed_shares, {"speed_shares",
                              Unit::none,
                              {1e-3, 1},
                              "Shares of the speed tried; the last to turn in place."});
    visit(self.outline, {"outline", Unit::none, {}, "Use of convex hulls of obstacles."});
  }
};

}  // namespace microswarm
