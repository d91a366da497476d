// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar_circles.hpp"

#include <fmt/format.h>

#include <cmath>

#include "microswarm/core/error.hpp"

namespace microswarm {

RadarCircles circles_of(const RadarParams& params, double swarm_radius) {
  const double prediction = swarm_radius + params.prediction_distance;  // Eq 6
  return {.prediction = prediction,
          .safety = prediction + params.safety_distance,        // Eq 7
          .detection = swarm_radius + params.detection_range};  // Eq 7
}

int directions_of(const RadarParams& params) {
  return static_cast<int>(std::lround(2 * pi / params.angle_step));
}

void check(const RadarParams& params, const std::string& where) {
  const double safety = params.prediction_distance + params.safety_distance;
  if (params.detection_range < safety)
    throw InputError(fmt::format(
        "{}: navigator.detection_range_um is {:.4g}, less than prediction_distance_um + "
        "safety_distance_um, {:.4g}: the safety circle must lie within the detection circle",
        where, params.detection_range, safety));
  const double count = 2 * pi / params.angle_step;
  if (std::abs(count - std::round(count)) > 1e-9 * count || std::round(count) < 3)
    throw InputError(fmt::format("{}: navigator.angle_step_deg is {:.6g}, must divide 360", where,
                                 degrees(params.angle_step)));
  if (!(params.speed > 0))
    throw InputError(fmt::format("{}: navigator.speed_um_per_s is {:.4g}, must be above 0", where,
                                 params.speed));
}

}  // namespace microswarm
