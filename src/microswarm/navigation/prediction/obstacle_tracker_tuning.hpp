// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/motion_fit_tuning.hpp"

namespace microswarm::navigation {

/// Constants of ObstacleTracker that rarely need a change.
struct ObstacleTrackerTuning {
  int noise_windows = 4;
  double outline_spacing = 0.4;
  MotionFitTuning fit{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.noise_windows,
          plain("noise_windows", 1, 20, "Frames kept for the noise estimate, in `frames`."));
    visit(self.outline_spacing,
          s("outline_spacing", 0, 60, "Minimum time between outlines that are compared."));
    visit(self.fit, plain("fit", "Fit of a motion to sightings."));
  }
};

}  // namespace microswarm::navigation
