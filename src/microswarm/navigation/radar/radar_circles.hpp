// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/navigation/radar/radar_params.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

namespace microswarm::navigation {

/// Circles of a swarm observed with the radius r_s [µm]: Eq 6, 7, 26 [radar].
RadarCircles make_circles(const RadarParams& params, double swarm_radius);

/// Number of directions, 360° / β.
int direction_count(const RadarParams& params);

/// Reports an issue if the safety circle is not within the detection circle, β does not divide
/// 360°, there is no speed, waypoints are both given and planned, the planner's parameters are
/// inconsistent, or `as_published` is combined with given values that are not the paper's.
Issues validate(const RadarParams& params, const IsGiven& is_given = {});

/// Reports an issue if d_p exceeds the swarm's minimum diameter and, without control of r_f, d_f. A
/// thin wall could then lie between a swarm and its predictive swarm, touching neither. The
/// published d_p is at most an eighth of a body length [radar].
Issues validate_step(const RadarParams& params, const SwarmLimits& swarm);

}  // namespace microswarm::navigation
