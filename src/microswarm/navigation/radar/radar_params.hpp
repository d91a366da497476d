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

namespace microswarm {

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
  SafetyRadiusParams safety_radius;
  double max_turn = radians(90);
  bool retreat = true;
  SafetyFilterParams safety_filter;
  bool compensate_delay = true;
  double obstacle_speed_bound = 0;
  std::vector<WaitZone> wait_zones;
  std::vector<Vec2> waypoints;
  double waypoint_tolerance = 50;
  bool global_plan = false;
  FmtStarParams planner;
  RadarTuning tuning;
  bool as_published = false;

  /// These parameters, with our additions disabled if `as_published`.
  RadarParams in_effect() const;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Commanded speed."});
    visit(self.prediction_distance, {"prediction_distance",
                                     Unit::um,
                                     {1e-3, 1e5},
                                     "Distance to a predictive swarm, centre to centre (d_p)."});
    visit(self.safety_distance,
          {"safety_distance", Unit::um, {0, 1e5}, "Minimum gap of a predictive swarm (d_f)."});
    visit(
        self.detection_range,
        {"detection_range", Unit::um, {1e-3, 1e6}, "Gap below which obstacles are avoided (d_r)."});
    visit(self.angle_step,
          {"angle_step", Unit::deg, {0.1, 90}, "Angle between directions (beta); divides 360."});
    visit(self.target_gain, {"target_gain",
                             Unit::none,
                             {0, 1e6},
                             "Growth of q_t with the remaining distance (k_t epsilon)."});
    visit(self.avoidance_gain, {"avoidance_gain",
                                Unit::none,
                                {0, 0.999},
                                "Growth of q_a with proximity (k_a eta); q_a < q_t."});
    visit(self.safety_radius,
          {"safety_radius", Unit::none, {}, "Control of the radius of the safety circle."});
    visit(self.max_turn, {"max_turn",
                          Unit::deg,
                          {30, 180},
                          "Largest turn while another direction is safe; 180: any.",
                          false,
                          "most_turn_deg"});
    visit(self.retreat,
          {"retreat", Unit::none, {}, "Retreat where no direction is safe; else hold."});
    visit(self.safety_filter, {"safety_filter",
                               Unit::none,
                               {},
                               "Safety filter (ours): keeps an escape open.",
                               false,
                               "guard"});
    visit(self.compensate_delay, {"compensate_delay",
                                  Unit::none,
                                  {},
                                  "Decide for the pose at which the command takes effect."});
    visit(self.obstacle_speed_bound, {"obstacle_speed_bound",
                                      Unit::um_per_s,
                                      {0, 1e5},
                                      "Speed of obstacles assumed during the dead time."});
    visit(self.wait_zones, {"wait_zones",
                            Unit::none,
                            {},
                            "Zones in which it waits for valves to open (A, D).",
                            false,
                            "wait_areas"});
    visit(self.waypoints, {"waypoints", Unit::um, {}, "Phased goals in order; none: planned."});
    visit(self.waypoint_tolerance, {"waypoint_tolerance",
                                    Unit::um,
                                    {1e-3, 1e6},
                                    "Distance at which a waypoint counts as reached."});
    visit(
        self.global_plan,
        {"global_plan", Unit::none, {}, "Plan waypoints around walls; else straight to the goal."});
    visit(self.planner, {"planner", Unit::none, {}, "Planner of the waypoints."});
    visit(self.as_published,
          {"as_published", Unit::none, {}, "As in [radar], without our additions."});
    visit(self.tuning, {"tuning", Unit::none, {}, "Constants that seldom need a change."});
  }
};

}  // namespace microswarm
