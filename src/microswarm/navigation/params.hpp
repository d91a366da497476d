// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/navigation/baselines/potential_field_params.hpp"
#include "microswarm/navigation/baselines/straight_params.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle_params.hpp"
#include "microswarm/navigation/following/path_navigator_params.hpp"
#include "microswarm/navigation/gathering/aggregation_params.hpp"
#include "microswarm/navigation/global_input/plan_executor_params.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"
#include "microswarm/navigation/radar/radar_params.hpp"

namespace microswarm {

/// Any navigator, chosen at run time by its `type`.
using NavigatorParams = std::variant<HierarchicalParams, PlanExecutorParams, AggregationParams,
                                     RadarParams, StraightParams, PotentialFieldParams,
                                     VelocityObstacleParams, PredictiveParams, PathNavigatorParams>;

/// The parameters, without what is ours where `as_published` says so: they read back without a
/// contradiction.
NavigatorParams in_effect(const NavigatorParams& params);

/// Least distance [µm] from its centre that the navigator keeps for a swarm seen as one body.
double required_clearance(const NavigatorParams& params);

/// How near [µm] to the swarm's edge an obstacle is when it begins to be avoided, for metrics: the
/// detection range d_r of the radar, and 50 µm of those that have none.
double detection_range_of(const NavigatorParams& params);

/// The follower's parameters of a navigator that follows a path; null for others.
const FollowerParams* follower_of(const NavigatorParams& params);
FollowerParams* follower_of(NavigatorParams& params);

}  // namespace microswarm
