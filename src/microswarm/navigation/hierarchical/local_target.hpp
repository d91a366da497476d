// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/planning/path/planners.hpp"

namespace microswarm::navigation {

/// Selected target and the circle that determined its distance.
struct LocalTarget {
  Vec2 position{};
  Detection detection{};
};

/// Input of Algorithm 1.
struct LocalTargetQuery {
  Pose2 swarm{};                          ///< s_s
  double goal_heading = 0;                ///< α_g
  double goal_distance = 0;               ///< ‖s_s − s_g‖: maximum distance of a target
  std::optional<Vec2> previous_target{};  ///< s_gpre
  double clearance = 0;                   ///< r_s for CollisionFree [µm]
  double min_distance = 0;                ///< the swarm's radius, at which halving ends
};

/// D_ts of the query [µm]: the base distance times ρ of the detection circle (Eq 3 [drrt]).
double target_distance(const Snapshot& world, const LocalTargetQuery& query,
                       const LocalTargetParams& params, const Stop& stop = {});

/// Algorithm 1 [drrt]. If no candidate is free, the fan widens to the full circle, then D_ts is
/// halved down to `min_distance`. Empty if nothing is free even then, and at once if the swarm
/// itself is not free, and if stopped.
std::optional<LocalTarget> select_local_target(const Snapshot& world, const LocalTargetQuery& query,
                                               const LocalTargetParams& params,
                                               const Stop& stop = {});

}  // namespace microswarm::navigation
