// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_params.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/predictive/predictive_tuning.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"

namespace microswarm::navigation {

/// Cost of being near an obstacle, in seconds per second.
struct RiskParams {
  double contact = 30;
  double penetration_cost = 30;
  double proximity_cost = 2;
  double reach = 40;
  double softness = 6;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.contact, plain("contact", 0, 1e6, "Cost rate in contact."));
    visit(self.penetration_cost,
          plain("penetration_cost", 0, 1e6, "Extra cost rate when one `reach` inside an obstacle.")
              .formerly("depth"));
    visit(self.proximity_cost,
          plain("proximity_cost", 0, 1e6, "Extra cost rate at contact; falls to 0 at `reach`.")
              .formerly("nearness"));
    visit(self.reach, um("reach", 1, 1e5, "Gap above which an obstacle has no cost."));
    visit(self.softness,
          um("softness", 1e-3, 1e4, "Gap at which the contact cost has fallen to half."));
  }
};

/// Predictive navigator (ours). Obstacles faster than the swarm cannot be outrun, but they can be
/// predicted from past observations (MultiModelPredictor). A time-expanded cost-to-go gives the
/// best path over the horizon (TimeField). Its first leg is chosen with exact distances and
/// commanded until the next frame.
struct PredictiveParams {
  static constexpr std::string_view type_name = "predictive";
  double speed = 80;
  double gap = 3;
  double wall_gap = 4;
  double horizon = 6;
  double step = 0.5;
  int directions = 48;
  RiskParams risk{};
  MultiModelPredictorParams prediction{};
  Guide guide = Guide::route;
  double route_cell = 20;
  PredictiveTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.gap,
          um("gap", 0, 1e5, "Gap to obstacles that counts as contact.").formerly("margin_um"));
    visit(self.wall_gap, um("wall_gap", 0, 1e5, "Gap kept to walls.").formerly("wall_margin_um"));
    visit(self.horizon, s("horizon", 0.2, 60, "Prediction time."));
    visit(self.step, s("step", 0.05, 10, "Time step of the cost-to-go."));
    visit(self.directions, plain("directions", 4, 720, "Number of directions of the first leg."));
    visit(self.risk, plain("risk", "Cost of being near obstacles."));
    visit(self.prediction, plain("prediction", "Prediction of obstacles.").formerly("foresight"));
    visit(self.guide, plain("guide", "Direction of the goal: straight or route."));
    visit(self.route_cell, um("route_cell", 1e-2, 1e5, "Grid spacing of the route."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
