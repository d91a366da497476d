// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_params.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_tuning.hpp"

namespace microswarm::navigation {

/// Safe-interval navigator (ours). It plans the earliest arrival at the goal in space and time
/// among predicted obstacles (any-angle SIPP), keeps the plan while it is safe, and checks the next
/// seconds of every command exactly.
struct SafeIntervalParams {
  /// Prediction whose past errors count as uncertainty.
  static MultiModelPredictorParams default_prediction() {
    MultiModelPredictorParams p;
    p.uncertainty = 0.5;
    p.max_uncertainty = 12;
    return p;
  }

  static constexpr std::string_view type_name = "safe_interval";
  double speed = 80;
  double gap = 5;
  double gap_rate = 1;
  double max_gap = 10;
  double wall_gap = 4;
  double horizon = 16;
  double cell_share = 0.25;
  double replan_period = 0.5;
  double switch_time = 0.5;
  MultiModelPredictorParams prediction = default_prediction();
  SafeIntervalTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.gap, um("gap", 0, 1e5, "Gap to obstacles of a plan."));
    visit(self.gap_rate, um_per_s("gap_rate", 0, 1e5, "Growth of the gap with prediction time."));
    visit(self.max_gap, um("max_gap", 0, 1e5, "Upper bound of the gap without uncertainty."));
    visit(self.wall_gap, um("wall_gap", 0, 1e5, "Gap kept to walls."));
    visit(self.horizon, s("horizon", 0.5, 120, "Prediction time, in 64 slots."));
    visit(self.cell_share,
          plain("cell_share", 0.02, 1, "Side of a cell, as a share of the swarm's radius."));
    visit(self.replan_period, s("replan_period", 0, 60, "Time after which a plan is reviewed."));
    visit(self.switch_time,
          s("switch_time", 0, 60, "Time that another plan must save to replace the kept one."));
    visit(self.prediction, plain("prediction", "Prediction of obstacles."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
