// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/navigation/baselines/potential_field_params.hpp"
#include "microswarm/navigation/baselines/straight_params.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle_params.hpp"
#include "microswarm/navigation/following/path_navigator_params.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_params.hpp"
#include "microswarm/navigation/global_input/plan_executor_params.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/radar/radar_params.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_params.hpp"

namespace microswarm::navigation {

/// Any navigator, selected at run time by its `type`.
using NavigatorParams =
    std::variant<HierarchicalParams, PlanExecutorParams, AggregationParams, RadarParams,
                 StraightParams, PotentialFieldParams, VelocityObstacleParams, PathNavigatorParams,
                 SafeIntervalParams>;

/// Parameters with our additions disabled where `as_published` is set; they can be read back
/// without a contradiction.
NavigatorParams in_effect(const NavigatorParams& params);

/// Minimum distance [µm] from its centre that the navigator keeps for a single-body swarm.
double required_clearance(const NavigatorParams& params);

/// Gap [µm] to the swarm's edge at which an obstacle begins to be avoided, for metrics: the
/// detection range d_r of the radar, 50 µm for navigators without one.
double required_detection_range(const NavigatorParams& params);

/// Follower parameters of a path-following navigator; null for others.
const FollowerParams* find_follower(const NavigatorParams& params);
FollowerParams* find_follower(NavigatorParams& params);

}  // namespace microswarm::navigation
