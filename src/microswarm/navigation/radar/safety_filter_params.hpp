// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm {

/// Safety filter, ours, not in [radar]: a command passes only if it leaves a way out, to hold or to
/// go straight into some direction, free of contact as far as is foreseen. Else the nearest command
/// that leaves one is given. Obstacles go on as they were seen to move.
struct SafetyFilterParams {
  bool active = true;
  double horizon = 5;
  double step = 0.2;
  int directions = 36;
  double commitment = 0.7;
  double gap = 12;
  double gap_rate = 4;
  double wall_gap = 10;
  ObstacleTrackerParams tracker;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.active, {"active", Unit::none, {}, "Whether it is asked at all."});
    visit(self.horizon, {"horizon", Unit::s, {0.1, 60}, "How long a way out must be free."});
    visit(self.step, {"step", Unit::s, {0.01, 10}, "Of time, between two looks at a way out."});
    visit(self.directions, {"directions", Unit::none, {4, 360}, "Of ways out, evenly spread."});
    visit(self.commitment,
          {"commitment",
           Unit::s,
           {0, 10},
           "A command must leave a way out even if it lasts so long: the longer, the less the "
           "swarm turns to and fro."});
    visit(self.gap, {"margin", Unit::um, {0, 1e5}, "Gap to obstacles that counts as contact."});
    visit(self.gap_rate,
          {"margin_rate", Unit::um_per_s, {0, 1e5}, "It grows so fast for what moves."});
    visit(self.wall_gap, {"wall_margin", Unit::um, {0, 1e5}, "Gap that is kept to walls."});
    visit(self.tracker, {"tracker", Unit::none, {}, "How the obstacles' motion is told."});
  }
};

}  // namespace microswarm
