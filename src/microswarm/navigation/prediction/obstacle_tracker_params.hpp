// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_tuning.hpp"

namespace microswarm::navigation {

/// Data used by ObstacleTracker for a motion estimate.
struct ObstacleTrackerParams {
  int frames = 12;
  double memory = 4;
  ObstacleTrackerTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frames, plain("frames", 2, 100, "Maximum number of frames for a motion estimate."));
    visit(self.memory,
          s("memory", 1e-2, 60, "Time for which frames are kept for the noise estimate."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
