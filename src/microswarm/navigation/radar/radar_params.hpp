// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/radar/radar_tuning.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"
#include "microswarm/navigation/radar/safety_radius_params.hpp"
#include "microswarm/navigation/radar/wait_zone_params.hpp"
#include "microswarm/planning/trees/fmt_star_params.hpp"

namespace microswarm::navigation {

/// Radar-based navigation among moving obstacles [radar]. Our additions are keeping to one side,
/// the retreat, the safety filter and the delay compensation. `as_published` disables them all.
struct RadarParams {
  static constexpr std::string_view type_name = "radar";
  double speed = 85.8;
  double prediction_distance = 25;  // d_p
  double safety_distance = 25;      // d_f
  double detection_range = 70;      // d_r
  double angle_step = pi / 180;     // β
  double target_gain = 0.1;         // k_t ε
  double avoidance_gain = 0.9;      // k_a η
  bool printed_weights = false;
  SafetyRadiusParams safety_radius{};
  double max_turn = radians(90);
  bool retreat = true;
  SafetyFilterParams safety_filter{};
  bool compensate_delay = true;
  double obstacle_speed_bound = 0;
  std::vector<WaitZone> wait_zones{};
  std::vector<Vec2> waypoints{};
  double waypoint_tolerance = 50;
  bool global_plan = false;
  planning::FmtStarParams planner{};
  RadarTuning tuning{};
  bool as_published = false;

  /// These parameters, with our additions disabled if `as_published`.
  RadarParams in_effect() const;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.prediction_distance, um("prediction_distance", 1e-3, 1e5,
                                       "Distance to a predictive swarm, centre to centre (d_p)."));
    visit(self.safety_distance,
          um("safety_distance", 0, 1e5, "Minimum gap of a predictive swarm (d_f)."));
    visit(self.detection_range,
          um("detection_range", 1e-3, 1e6, "Gap below which obstacles are avoided (d_r)."));
    visit(self.angle_step,
          deg("angle_step", 0.1, 90, "Angle between directions (beta); divides 360."));
    visit(self.target_gain,
          plain("target_gain", 0, 1e6, "Growth of q_t with the remaining distance (k_t epsilon)."));
    visit(self.avoidance_gain,
          plain("avoidance_gain", 0, 0.999, "Growth of q_a with proximity (k_a eta); q_a < q_t."));
    visit(self.printed_weights,
          plain("printed_weights", "q_a of Eq 10 as printed, by centre distances; at most q_t."));
    visit(self.safety_radius,
          plain("safety_radius", "Control of the radius of the safety circle."));
    visit(self.max_turn,
          deg("max_turn", 30, 180, "Largest turn while another direction is safe; 180: any.")
              .formerly("most_turn_deg"));
    visit(self.retreat, plain("retreat", "Retreat where no direction is safe; else hold."));
    visit(self.safety_filter,
          plain("safety_filter", "Safety filter (ours): keeps an escape open.").formerly("guard"));
    visit(self.compensate_delay,
          plain("compensate_delay", "Decide for the pose at which the command takes effect."));
    visit(self.obstacle_speed_bound, um_per_s("obstacle_speed_bound", 0, 1e5,
                                              "Speed of obstacles assumed during the dead time."));
    visit(self.wait_zones, plain("wait_zones", "Zones in which it waits for valves to open (A, D).")
                               .formerly("wait_areas"));
    visit(self.waypoints, um("waypoints", "Phased goals in order; none: planned."));
    visit(self.waypoint_tolerance,
          um("waypoint_tolerance", 1e-3, 1e6, "Distance at which a waypoint counts as reached."));
    visit(self.global_plan,
          plain("global_plan", "Plan waypoints around walls; else straight to the goal."));
    visit(self.planner, plain("planner", "Planner of the waypoints."));
    visit(self.as_published, plain("as_published", "As in [radar], without our additions."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
