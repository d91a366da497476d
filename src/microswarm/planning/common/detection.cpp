// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/detection.hpp"

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {

Detection detect(const Snapshot& world, Disc circle, double rho_min, const Stop& stop) {
  Detection detection{circle, 0, 0, 1};
  if (!(circle.radius > 0)) return detection;
  const Survey seen = world.survey(circle, stop);
  const double area = pi * circle.radius * circle.radius;
  detection.w1 = std::clamp(seen.covered_area / area, 0.0, 1.0);  // Eq 1 [drrt]
  if (seen.obstacles > 0) {                                       // Eq 2 [drrt]
    const double mean_distance = seen.distance_sum / seen.obstacles;
    detection.w2 = std::clamp(1 - mean_distance / circle.radius, 0.0, 1.0);
  }
  detection.rho =
      std::max(rho_min, 0.5 + 0.5 * (1 - (detection.w1 + detection.w2)));  // Eq 3 [drrt]
  return detection;
}

}  // namespace microswarm::planning
