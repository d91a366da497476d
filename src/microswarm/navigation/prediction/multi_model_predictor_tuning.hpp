// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/motion_models_tuning.hpp"
#include "microswarm/navigation/prediction/motion_trail_tuning.hpp"
#include "microswarm/navigation/prediction/oscillation_tuning.hpp"

namespace microswarm::navigation {

/// Constants of MultiModelPredictor that rarely need a change. Priors are the errors expected of a
/// model before it has shown any, as shares of the predicted distance.
struct MultiModelPredictorTuning {
  double max_gap = 1;
  double forecast_interval = 0.08;
  double near_forecast = 0.5;
  double far_forecast = 1.5;
  double max_error = 300;
  double error_tolerance = 0.5;
  double growth_time = 1.5;
  double prior_weight = 2;
  double straight_prior = 0.20;
  double curved_prior = 0.17;
  double swing_prior = 0.20;
  double arc_prior = 0.20;
  double recurrence_prior = 0.14;
  MotionModelsTuning models{};
  RecurrenceTuning recurrence{};
  OscillationTuning oscillation{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.max_gap, s("max_gap", 0, 1e3, "Time without a sighting after which a body is new."));
    visit(self.forecast_interval,
          s("forecast_interval", 0, 10, "Minimum time between two forecasts."));
    visit(self.near_forecast,
          s("near_forecast", 1e-2, 60, "Shorter time ahead at which models are judged."));
    visit(self.far_forecast,
          s("far_forecast", 1e-2, 60, "Longer time ahead at which models are judged."));
    visit(self.max_error, um("max_error", 0, 1e6, "Upper bound of an error that counts."));
    visit(self.error_tolerance,
          um("error_tolerance", 0, 1e4, "Error that counts as none, besides the noise."));
    visit(self.growth_time,
          s("growth_time", 0, 60, "Time for which an outline keeps growing as observed."));
    visit(self.prior_weight, plain("prior_weight", 0, 1e3, "Weight of the priors, in forecasts."));
    visit(self.straight_prior, plain("straight_prior", 0, 10, "Prior of the straight motion."));
    visit(self.curved_prior, plain("curved_prior", 0, 10, "Prior of the accelerated motion."));
    visit(self.swing_prior, plain("swing_prior", 0, 10, "Prior of swings on a line or ellipse."));
    visit(self.arc_prior, plain("arc_prior", 0, 10, "Prior of swings on a circle."));
    visit(self.recurrence_prior,
          plain("recurrence_prior", 0, 10, "Prior of the recurrent motion."));
    visit(self.models, plain("models", "Models of a body's motion."));
    visit(self.recurrence, plain("recurrence", "Search for a recurrence of a motion."));
    visit(self.oscillation, plain("oscillation", "Fit of oscillations."));
  }
};

}  // namespace microswarm::navigation
