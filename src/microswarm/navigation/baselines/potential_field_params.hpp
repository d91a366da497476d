// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/baselines/potential_field_tuning.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"

namespace microswarm::navigation {

/// Baseline: artificial potential field for moving obstacles after Ge and Cui (Autonomous Robots
/// 13, 2002). The target attracts with a force of 1. A wall, border or obstacle at the gap g repels
/// with k (x − 1) x², x = influence / g, the negative gradient of ½ k g₀ (x − 1)². The gap to a
/// moving obstacle is reduced by the approach within the reaction time.
struct PotentialFieldParams {
  static constexpr std::string_view type_name = "potential_field";
  double speed = 60;
  double repulsion = 0.1;  // k
  double influence = 150;  // g₀
  double wall_influence = 20;
  double reaction_time = 0.5;
  double min_force = 0.05;
  double gap = 10;
  Guide guide = Guide::route;
  ObstacleTrackerParams tracker{};
  PotentialFieldTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.repulsion,
          plain("repulsion", 0, 1e6, "Gain of the repulsion; the attraction is 1."));
    visit(self.influence, um("influence", 1e-3, 1e6, "Gap above which obstacles do not repel."));
    visit(self.wall_influence,
          um("wall_influence", 1e-3, 1e6, "Gap above which walls do not repel."));
    visit(self.reaction_time,
          s("reaction_time", 0, 60, "Time by which the approach of an obstacle is anticipated."));
    visit(self.min_force,
          plain("min_force", 0, 1, "Force below which the swarm is stuck and holds.")
              .formerly("least_force"));
    visit(self.gap, um("gap", 0, 1e5, "Distance from the swarm's edge where gaps begin.")
                        .formerly("margin_um"));
    visit(self.guide, plain("guide", "Direction of the goal: straight or route."));
    visit(self.tracker, plain("tracker", "Estimation of the obstacles' motion."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
