// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/issue.hpp"
#include "microswarm/navigation/radar/radar_params.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

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

/// Issues when the safety circle is not within the detection circle, β does not divide 360°, the
/// speed is none, waypoints are both given and to be planned, the planner's parameters do not fit
/// together, or `as_published` stands beside given values that are not the paper's.
Issues validate(const RadarParams& params, const IsGiven& is_given = {});

/// An issue when d_p is more than the swarm's least diameter and, where r_f is not controlled, d_f:
/// then a thin wall could lie between a swarm and its predictive swarm, and neither would touch it.
/// The published d_p is at most an eighth of a body length [radar].
Issues validate_step(const RadarParams& params, const SwarmLimits& swarm);

}  // namespace microswarm
