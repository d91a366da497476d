// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of ObstaclePredictor that rarely need a change.
struct ObstaclePredictorTuning {
  double min_significance = 2;
  double growth_time = 2;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.min_significance,
          plain("min_significance", 0, 100, "Standard errors up to which a velocity counts as 0."));
    visit(self.growth_time,
          s("growth_time", 0, 60, "Time for which an outline keeps growing as observed."));
  }
};

}  // namespace microswarm::navigation
