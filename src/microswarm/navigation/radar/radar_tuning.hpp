// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of RadarNavigator that rarely need a change.
struct RadarTuning {
  double replan_interval = 1;
  double max_replan_interval = 30;
  int retreat_directions = 36;
  double min_retreat_gain = 0.1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.replan_interval, s("replan_interval", 0, 1e4, "Minimum time between two plans."));
    visit(self.max_replan_interval,
          s("max_replan_interval", 0, 1e5, "Longest wait after plans that failed."));
    visit(self.retreat_directions,
          plain("retreat_directions", 1, 3600, "Number of retreat headings tested."));
    visit(self.min_retreat_gain, plain("min_retreat_gain", 0, 100,
                                       "Gain of a retreat over a hold, in prediction distances."));
  }
};

}  // namespace microswarm::navigation
