// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"

namespace microswarm::navigation {

/// Input of the target selection among predicted obstacles.
struct PredictedTargetQuery {
  Pose2 swarm{};                         ///< predicted pose when the command takes effect
  double delay = 0;                      ///< from the frame until then [s]
  double speed = 0;                      ///< [µm/s]
  Vec2 goal{};                           ///< free with the clearance
  Vec2 towards{};                        ///< the goal, or a point of the route to it, in sight
  double reach = 0;                      ///< farthest target [µm]
  double min_reach = 0;                  ///< minimum distance of a target other than the goal [µm]
  double angle_step = 0;                 ///< between directions [rad]
  double turn_weight = 0;                ///< cost of turning [µm/rad]
  double clearance = 0;                  ///< [µm]
  double horizon = 0;                    ///< [s]
  double max_wait = infinity;            ///< for an obstacle to pass [s]
  std::span<const double> wait_times{};  ///< ascending from 0 [s]
  double wait_weight = 0;                ///< of the distance not driven during a wait
  double contact_weight = 0;             ///< of the distance left in the horizon at a contact
};

/// Selected target, and the time [s] the swarm waits for an obstacle to pass before it goes.
struct PredictedTarget {
  Vec2 position{};
  double wait = 0;
};

/// Selects a local target in space and time (ours, besides Algorithm 1 [drrt]). The swarm goes
/// straight to the target, at once or after an obstacle has passed, then straight towards the goal.
/// All obstacles move as predicted. Of the targets reached with the clearance, the one of minimum
/// cost is taken. The cost is the distance to the target, `length_from` it to the goal [µm],
/// turning, and the loss by waiting and by meeting an obstacle beyond the target within the
/// horizon. Nothing if no target can be reached.
std::optional<PredictedTarget> select_predicted_target(
    const Snapshot& frame, const ObstaclePredictor& obstacles, const PredictedTargetQuery& query,
    const std::function<double(Vec2)>& length_from);

/// Whether the path is collision-free when followed from its first point at `speed` [µm/s], `delay`
/// [s] after the frame: among predicted obstacles for at most `horizon` [s], among walls for the
/// whole path.
bool is_free_in_time(const Snapshot& frame, const ObstaclePredictor& obstacles,
                     std::span<const Vec2> path, double speed, double delay, double horizon,
                     double clearance);

}  // namespace microswarm::navigation
