// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "microswarm/core/places.hpp"
#include "microswarm/navigation/aggregation.hpp"
#include "microswarm/navigation/hierarchical.hpp"
#include "microswarm/navigation/path_navigator.hpp"
#include "microswarm/navigation/plan_player.hpp"
#include "microswarm/navigation/potential_field.hpp"
#include "microswarm/navigation/predictive.hpp"
#include "microswarm/navigation/radar.hpp"
#include "microswarm/navigation/straight.hpp"
#include "microswarm/navigation/velocity_obstacle.hpp"
#include "microswarm/swarm/robot_swarm.hpp"

namespace microswarm {

/// Any navigator, chosen at run time by its `type`.
using NavigatorParams = std::variant<HierarchicalParams, PlanPlayerParams, AggregationParams,
                                     RadarParams, StraightParams, PotentialFieldParams,
                                     VelocityObstacleParams, PredictiveParams, PathNavigatorParams>;

/// What a navigator is told of its task.
struct Task {
  SwarmLimits swarm;                       ///< of a swarm that is seen as one body
  std::optional<RobotSwarmParams> robots;  ///< of one whose robots are told apart
  std::optional<Vec2> goal;                ///< nothing when the robots have goals of their own
  double goal_tolerance = 0;               ///< [µm]
  double tick = 0.1;                       ///< between two commands [s]
};

/// What a navigator can steer: nothing when it can do the task, else what it lacks.
std::string_view what_it_lacks(const NavigatorParams& params, const Task& task);

/// Throws InputError, one line, when the navigator's parameters make no sense together, for this
/// swarm or on this map; `where` knows the keys of a scenario.
void check_navigator(const NavigatorParams& params, const Task& task, const Map& map,
                     const Places& where);

/// The parameters, without what is ours where `as_published` says so: they read back without a
/// contradiction.
NavigatorParams in_effect(const NavigatorParams& params);

/// Least distance [µm] from its centre that the navigator keeps for a swarm seen as one body.
double margin_of(const NavigatorParams& params);

/// How near [µm] to the swarm's edge an obstacle is when it begins to be avoided, for metrics: the
/// detection range d_r of the radar, and 50 µm of those that have none.
double detection_range_of(const NavigatorParams& params);

/// Age [s] from which on the navigator holds a frame for too old.
double frame_timeout_of(const NavigatorParams& params);

/// The follower's parameters of a navigator that follows a path; null for others.
const FollowerParams* follower_of(const NavigatorParams& params);
FollowerParams* follower_of(NavigatorParams& params);

/// The navigator with these parameters; it lacks nothing for the task.
std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task, Rng rng);

}  // namespace microswarm
