// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/navigation/radar_params.hpp"

namespace microswarm {

/// Radii of the three circles around the swarm's centre [µm]: Fig 2 [radar].
struct RadarCircles {
  double prediction = 0;  ///< r_p
  double safety = 0;      ///< r_f
  double detection = 0;   ///< r_d
};

/// The circles of a swarm that is seen with the radius r_s [µm]: Eq 6, 7, 26 [radar].
RadarCircles circles_of(const RadarParams& params, double swarm_radius);

/// 360° / β: the number of directions.
int directions_of(const RadarParams& params);

/// Throws InputError, one line that begins with `where`, when the safety circle is not within the
/// detection circle, β does not divide 360°, or the speed is none.
void check(const RadarParams& params, const std::string& where);

}  // namespace microswarm
