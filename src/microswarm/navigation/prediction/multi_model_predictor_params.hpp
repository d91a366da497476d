// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_tuning.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm::navigation {

/// Selection of the motion models of obstacles, and their uncertainty.
struct MultiModelPredictorParams {
  double memory = 60;
  double error_time_constant = 2;
  double uncertainty = 0;
  double max_uncertainty = 60;
  ObstacleTrackerParams tracker{};
  MultiModelPredictorTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.memory, s("memory", 0, 1e4, "Time for which observed motion is remembered."));
    visit(self.error_time_constant, s("error_time_constant", 1e-2, 1e3,
                                      "Time constant with which a model's errors are forgotten.")
                                        .formerly("proof_time_s"));
    visit(self.uncertainty,
          plain("uncertainty_gain", 0, 10, "Share of past errors added to an obstacle's size.")
              .formerly("doubt"));
    visit(self.max_uncertainty,
          um("max_uncertainty", 0, 1e4, "Upper bound of the added uncertainty.")
              .formerly("most_doubt_um"));
    visit(self.tracker, plain("tracker", "Estimation of the obstacles' motion."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
