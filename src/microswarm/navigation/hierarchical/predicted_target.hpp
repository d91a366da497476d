// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "microswarm/core/infinity.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"

namespace microswarm {

/// What a local target is chosen from among predicted obstacles.
struct PredictedTargetQuery {
  Pose2 swarm;                           ///< where it will be when the command takes effect
  double delay = 0;                      ///< from the frame until then [s]
  double speed = 0;                      ///< [µm/s]
  Vec2 goal;                             ///< free with the clearance
  Vec2 towards;                          ///< the goal, or a point of the route to it, in sight
  double reach = 0;                      ///< farthest target [µm]
  double min_reach = 0;                  ///< nearest target, but for the goal [µm]
  double angle_step = 0;                 ///< between directions [rad]
  double turn_weight = 0;                ///< cost of turning [µm/rad]
  double clearance = 0;                  ///< [µm]
  double horizon = 0;                    ///< [s]
  double max_wait = infinity;            ///< for an obstacle to pass [s]
  std::span<const double> wait_times{};  ///< ascending from 0 [s]
  double wait_weight = 0;                ///< of the distance not driven during a wait
  double contact_weight = 0;             ///< of the distance left in the horizon at a contact
};

/// A chosen target, and how long [s] the swarm waits for an obstacle to pass before it goes.
struct PredictedTarget {
  Vec2 position;
  double wait = 0;
};

/// Selection of a local target in space and time, ours beside Algorithm 1 [drrt]: the swarm goes
/// straight to the target, at once or when an obstacle has passed, then straight towards the goal,
/// and all obstacles go on as predicted. Of the targets that it reaches with the
/// clearance the one of the least cost is taken: way to the target, `way_from` it to the goal [µm],
/// turning, and what is lost by waiting and by meeting an obstacle behind the target within the
/// horizon. Nothing when no target can be reached.
std::optional<PredictedTarget> select_predicted_target(const Snapshot& frame,
                                                       const ObstaclePredictor& obstacles,
                                                       const PredictedTargetQuery& query,
                                                       const std::function<double(Vec2)>& way_from);

/// Is the path free when it is driven from its first point at `speed` [µm/s], `delay` [s] after the
/// frame, for at most `horizon` [s] among predicted obstacles, and for all of it among walls?
bool is_free_in_time(const Snapshot& frame, const ObstaclePredictor& obstacles,
                     std::span<const Vec2> path, double speed, double delay, double horizon,
                     double clearance);

}  // namespace microswarm
