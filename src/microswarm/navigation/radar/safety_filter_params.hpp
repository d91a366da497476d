// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/radar/safety_filter_tuning.hpp"

#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm::navigation {

/// Safety filter (ours, not in [radar]). A command passes only if a collision-free escape remains
/// after it: to hold, or to move straight in some direction. Otherwise the nearest command with an
/// escape replaces it. Obstacles are extrapolated at their estimated velocity.
struct SafetyFilterParams {
  bool active = true;
  double horizon = 5;
  double step = 0.2;
  int directions = 36;
  double commitment = 0.7;
  double gap = 12;
  double gap_rate = 4;
  double wall_gap = 10;
  ObstacleTrackerParams tracker{};
  SafetyFilterTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.active, plain("active", "Use the safety filter."));
    visit(self.horizon, s("horizon", 0.1, 60, "Time for which an escape must be free."));
    visit(self.step, s("step", 0.01, 10, "Time step of the escape check."));
    visit(self.directions, plain("directions", 4, 360, "Number of escape headings tested."));
    visit(self.commitment, s("commitment", 0, 10, "Time after which an escape must still remain."));
    visit(self.gap,
          um("gap", 0, 1e5, "Gap to obstacles that counts as contact.").formerly("margin_um"));
    visit(self.gap_rate,
          um_per_s("gap_rate", 0, 1e5, "Growth of the gap per second for moving obstacles.")
              .formerly("margin_rate_um_per_s"));
    visit(self.wall_gap, um("wall_gap", 0, 1e5, "Gap kept to walls.").formerly("wall_margin_um"));
    visit(self.tracker, plain("tracker", "Estimation of the obstacles' motion."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
