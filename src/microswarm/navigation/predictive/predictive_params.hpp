// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_params.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/predictive/predictive_tuning.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"

namespace microswarm {

/// Cost of being near an obstacle, in seconds per second.
struct RiskParams {
  double contact = 30;
  double penetration_cost = 30;
  double proximity_cost = 2;
  double reach = 40;
  double softness = 6;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.contact, {"contact", Unit::none, {0, 1e6}, "Cost rate in contact."});
    visit(self.penetration_cost, {"penetration_cost",
                                  Unit::none,
                                  {0, 1e6},
                                  "Extra cost rate when one `reach` inside an obstacle.",
                                  false,
                                  "depth"});
    visit(self.proximity_cost, {"proximity_cost",
                                Unit::none,
                                {0, 1e6},
                                "Extra cost rate at contact; falls to 0 at `reach`.",
                                false,
                                "nearness"});
    visit(self.reach, {"reach", Unit::um, {1, 1e5}, "Gap above which an obstacle has no cost."});
    visit(self.softness,
          {"softness", Unit::um, {1e-3, 1e4}, "Gap at which the contact cost has fallen to half."});
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
  RiskParams risk;
  MultiModelPredictorParams prediction;
  Guide guide = Guide::route;
  double route_cell = 20;
  PredictiveTuning tuning;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Commanded speed."});
    visit(self.gap, {"gap",
                     Unit::um,
                     {0, 1e5},
                     "Gap to obstacles that counts as contact.",
                     false,
                     "margin_um"});
    visit(self.wall_gap,
          {"wall_gap", Unit::um, {0, 1e5}, "Gap kept to walls.", false, "wall_margin_um"});
    visit(self.horizon, {"horizon", Unit::s, {0.2, 60}, "Prediction time."});
    visit(self.step, {"step", Unit::s, {0.05, 10}, "Time step of the cost-to-go."});
    visit(self.directions,
          {"directions", Unit::none, {4, 720}, "Number of directions of the first leg."});
    visit(self.risk, {"risk", Unit::none, {}, "Cost of being near obstacles."});
    visit(self.prediction,
          {"prediction", Unit::none, {}, "Prediction of obstacles.", false, "foresight"});
    visit(self.guide, {"guide", Unit::none, {}, "Direction of the goal: straight or route."});
    visit(self.route_cell, {"route_cell", Unit::um, {1e-2, 1e5}, "Grid spacing of the route."});
    visit(self.tuning, {"tuning", Unit::none, {}, "Constants that seldom need a change."});
  }
};

}  // namespace microswarm
