// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_circles.hpp"

#include <fmt/format.h>

#include <cmath>

#include "microswarm/core/fields/published.hpp"

namespace microswarm::navigation {

RadarCircles make_circles(const RadarParams& params, double swarm_radius) {
  const double prediction = swarm_radius + params.prediction_distance;  // Eq 6
  return {.prediction = prediction,
          .safety = prediction + params.safety_distance,        // Eq 7
          .detection = swarm_radius + params.detection_range};  // Eq 7
}

int direction_count(const RadarParams& params) {
  return static_cast<int>(std::lround(2 * pi / params.angle_step));
}

RadarParams RadarParams::in_effect() const {
  RadarParams p = *this;
  if (!as_published) return p;
  p.safety_filter = {.active = false};
  p.retreat = false;
  p.max_turn = radians(180);
  p.compensate_delay = false;
  p.obstacle_speed_bound = 0;
  return p;
}

Issues validate(const RadarParams& params, const IsGiven& is_given) {
  Issues issues;
  const double safety = params.prediction_distance + params.safety_distance;
  if (params.detection_range < safety)
    issues.add(
        {"detection_range_um", "prediction_distance_um", "safety_distance_um"},
        fmt::format(
            "navigator.detection_range_um is {:.4g}, less than prediction_distance_um + "
            "safety_distance_um, {:.4g}: the safety circle must lie within the detection circle",
            params.detection_range, safety));
  const double count = 2 * pi / params.angle_step;
  if (std::abs(count - std::round(count)) > 1e-9 * count || std::round(count) < 3)
    issues.add("angle_step_deg", fmt::format("navigator.angle_step_deg is {:.6g}, must divide 360",
                                             degrees(params.angle_step)));
  if (!(params.speed > 0))
    issues.add("speed_um_per_s",
               fmt::format("navigator.speed_um_per_s is {:.4g}, must be above 0", params.speed));
  if (params.global_plan && !params.waypoints.empty())
    issues.add({"global_plan", "waypoints_um"},
               "navigator.global_plan is true and navigator.waypoints_um are given: only one of "
               "them can be");
  issues.add_within("planner", validate(params.planner), "navigator.planner");
  if (params.as_published)
    issues.add(validate_published(is_given, params, params.in_effect(), RadarParams{}));
  return issues;
}

Issues validate_step(const RadarParams& params, const SwarmLimits& swarm) {
  Issues issues;
  const double kept = params.safety_radius.adaptive ? 0 : params.safety_distance;
  const double most = 2 * (swarm.radius - swarm.radius_variation) + kept;
  if (params.prediction_distance > most)
    issues.add(
        {"prediction_distance_um", "safety_distance_um"},
        fmt::format("navigator.prediction_distance_um is {:.4g}, more than the swarm's "
                    "least diameter{}, {:.4g}: it could step over a wall",
                    params.prediction_distance, kept > 0 ? " + safety_distance_um" : "", most));
  return issues;
}

}  // namespace microswarm::navigation
