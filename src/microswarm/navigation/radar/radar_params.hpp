// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"
#include "microswarm/navigation/radar/safety_radius_params.hpp"
#include "microswarm/navigation/radar/wait_zone_params.hpp"
#include "microswarm/planning/path/fmt_star_params.hpp"

namespace microswarm {

/// Radar-based navigation among moving obstacles [radar]. Ours besides: that it keeps to a side,
/// the retreat, the safety_filter, and that delays are made up for. `as_published` switches all
/// that off.
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
  bool as_published = false;

  /// These, or with `as_published` the same without what is ours.
  RadarParams in_effect() const;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Speed asked for."});
    visit(self.prediction_distance,
          {"prediction_distance",
           Unit::um,
           {1e-3, 1e5},
           "From the swarm to a predictive swarm, centre to centre (d_p)."});
    visit(
        self.safety_distance,
        {"safety_distance", Unit::um, {0, 1e5}, "Least gap that a predictive swarm keeps (d_f)."});
    visit(self.detection_range, {"detection_range",
                                 Unit::um,
                                 {1e-3, 1e6},
                                 "Obstacles nearer to the swarm's edge are avoided (d_r)."});
    visit(self.angle_step,
          {"angle_step", Unit::deg, {0.1, 90}, "Between two directions (beta); divides 360."});
    visit(self.target_gain,
          {"target_gain", Unit::none, {0, 1e6}, "Growth of q_t with the way left (k_t epsilon)."});
    visit(self.avoidance_gain, {"avoidance_gain",
                                Unit::none,
                                {0, 0.999},
                                "Growth of q_a with nearness (k_a eta); q_a stays below q_t."});
    visit(self.safety_radius,
          {"safety_radius", Unit::none, {}, "Control of the safety circle's radius."});
    visit(self.max_turn, {"most_turn",
                          Unit::deg,
                          {30, 180},
                          "Directions that turn more from the last one are taken only where no "
                          "other is safe; 180 as published."});
    visit(self.retreat,
          {"retreat", Unit::none, {}, "With no safe direction get away, else hold as published."});
    visit(self.safety_filter,
          {"guard", Unit::none, {}, "Keeps a way out open, foreseeing obstacles."});
    visit(self.compensate_delay,
          {"compensate_delay",
           Unit::none,
           {},
           "Decide for the place where the command takes effect, not for the one seen."});
    visit(self.obstacle_speed_bound,
          {"obstacle_speed_bound",
           Unit::um_per_s,
           {0, 1e5},
           "Obstacles count as nearer by their way at this speed in the dead time."});
    visit(self.wait_zones,
          {"wait_zones", Unit::none, {}, "Where to wait for valves to open (A, D)."});
    visit(self.waypoints,
          {"waypoints", Unit::um, {}, "Phased goals on the way, in order; none: as planned."});
    visit(self.waypoint_tolerance,
          {"waypoint_tolerance", Unit::um, {1e-3, 1e6}, "How near to a waypoint counts."});
    visit(self.global_plan, {"global_plan",
                             Unit::none,
                             {},
                             "Plan waypoints round the walls, else straight to the goal."});
    visit(self.planner, {"planner", Unit::none, {}, "Planner of the waypoints."});
    visit(self.as_published,
          {"as_published",
           Unit::none,
           {},
           "As in [radar]: no guard, no retreat, delays not made up for, turns as it likes, and "
           "every planned waypoint is visited."});
  }
};

}  // namespace microswarm
