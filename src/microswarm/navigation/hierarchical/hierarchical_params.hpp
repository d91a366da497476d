// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/following/follower_params.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_tuning.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"
#include "microswarm/planning/trees/drrt_star_params.hpp"

namespace microswarm::navigation {

/// Autonomous local target selection: Algorithm 1, Eq 4 [drrt].
struct LocalTargetParams {
  double base_distance = 320;       // D_base, four times the swarm's width
  double detection_diameter = 320;  // D_dec
  double rho_min = 0.2;
  double half_angle = pi / 2;   // α_search
  double angle_step = pi / 18;  // δα
  double obstacle_weight = 1;   // α_1
  double border_weight = 1;     // α_2
  double goal_weight = 8;       // α_3
  double direction_weight = 2;  // α_4
  std::optional<double> influence_range{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.base_distance, um("base_distance", 1e-3, 1e6, "Farthest target (D_base)."));
    visit(self.detection_diameter,
          um("detection_diameter", 1e-3, 1e6, "Diameter of the detection circle (D_dec)."));
    visit(self.rho_min, plain("rho_min", 1e-3, 1, "Floor of the adjust factor."));
    visit(self.half_angle, deg("half_angle", 1, 180, "Half of the fan (alpha_search)."));
    visit(self.angle_step, deg("angle_step", 0.5, 90, "Angle between directions (delta alpha)."));
    visit(self.obstacle_weight, plain("obstacle_weight", 0, 1e6, "Weight alpha_1, Eq 4c."));
    visit(self.border_weight, plain("border_weight", 0, 1e6, "Weight alpha_2, Eq 4d."));
    visit(self.goal_weight, plain("goal_weight", 0, 1e6, "Weight alpha_3, Eq 4e."));
    visit(self.direction_weight, plain("direction_weight", 0, 1e6, "Weight alpha_4, Eq 4f."));
    visit(self.influence_range,
          um("influence_range", 1e-3, 1e9, "Range R of Eq 4c and 4d; none: the number r_s²."));
  }
};

/// Hierarchical D-RRT* planning framework: Algorithm 4 [drrt] over local target selection
/// (Algorithm 1) and the local planner (Algorithms 2–3). Our additions are the guide along the map,
/// and the look-ahead that checks every command against predicted obstacles. With `as_published`
/// only Algorithm 4 remains (docs/explanation/hierarchical-drrt-star.md).
struct HierarchicalParams {
  /// D-RRT* with limits that suit a local target: near, and usually on a straight free line.
  static planning::DrrtStarParams local_planner() {
    planning::DrrtStarParams p;
    p.goal_bias = 0.5;
    p.max_nodes = 200;
    p.max_iterations = 50;
    p.exact_route = false;  // the navigator follows its own
    return p;
  }

  static constexpr std::string_view type_name = "hierarchical_drrt_star";
  double clearance = 90;  // r_s
  double extra_clearance = 10;
  double speed = 60;
  double lookahead = 60;
  FollowerParams follower{};
  double horizon = 3;
  double target_horizon = 8;
  bool as_published = false;
  Guide guide = Guide::route;
  double route_cell = 20;
  ObstacleTrackerParams tracker{};
  LocalTargetParams target{};
  planning::DrrtStarParams planner = local_planner();
  HierarchicalTuning tuning{};

  /// These parameters, with our additions disabled if `as_published`.
  HierarchicalParams in_effect() const;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance,
          um("clearance", 0, 1e5, "Minimum distance from the centre to obstacles (r_s).")
              .formerly("margin_um"));
    visit(self.extra_clearance,
          um("extra_clearance", 0, 1e5, "Clearance added while planning, where it fits.")
              .formerly("extra_margin_um"));
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.lookahead, um("lookahead", 1e-3, 1e5, "Lookahead distance of the path follower."));
    visit(self.follower, plain("follower", "Path follower."));
    visit(self.horizon, s("horizon", 0, 60, "Time for which a command is checked; 0: no check."));
    visit(self.target_horizon,
          s("target_horizon", 0, 60, "Prediction time of obstacles for targets; 0: none."));
    visit(self.as_published, plain("as_published", "Algorithm 4 [drrt] without our additions."));
    visit(self.guide, plain("guide", "Direction of the goal: straight or route."));
    visit(self.route_cell, um("route_cell", 1e-2, 1e5, "Grid spacing of the route."));
    visit(self.tracker, plain("tracker", "Estimation of the obstacles' motion."));
    visit(self.target, plain("target", "Local target selection."));
    visit(self.planner, plain("planner", "Local planner."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

/// Reports an issue if `as_published` is combined with given values that are not the paper's, there
/// is no share of the speed, or waits do not ascend from 0.
Issues validate(const HierarchicalParams& params, const IsGiven& is_given);

}  // namespace microswarm::navigation
