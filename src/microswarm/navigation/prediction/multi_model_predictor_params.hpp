// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm {

/// How the motion models of obstacles are judged and how far they are doubted.
struct MultiModelPredictorParams {
  double memory = 60;
  double error_time_constant = 2;
  double uncertainty = 0;
  double max_uncertainty = 60;
  ObstacleTrackerParams tracker;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.memory,
          {"memory", Unit::s, {0, 1e4}, "How long it is remembered how obstacles moved."});
    visit(self.error_time_constant,
          {"proof_time",
           Unit::s,
           {1e-2, 1e3},
           "Over which a model's past errors count when it is chosen, time constant."});
    visit(self.uncertainty,
          {"doubt", Unit::none, {0, 10}, "Share of its past errors by which an obstacle widens."});
    visit(self.max_uncertainty, {"most_doubt", Unit::um, {0, 1e4}, "By so much at most."});
    visit(self.tracker, {"tracker", Unit::none, {}, "How the obstacles' motion is told."});
  }
};

}  // namespace microswarm
