// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle_tuning.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"

namespace microswarm::navigation {

/// Baseline: velocity obstacles (Fiorini and Shiller, IJRR 17, 1998), not reciprocal. Of the
/// velocities on a grid of directions and speeds that are collision-free within the horizon, it
/// takes the one nearest to the preferred velocity, which is full speed towards the target.
struct VelocityObstacleParams {
  static constexpr std::string_view type_name = "velocity_obstacle";
  double speed = 60;
  int directions = 72;
  int speeds = 4;
  double horizon = 4;
  double wall_horizon = 1;
  double gap = 10;
  double urgency = 200;
  Guide guide = Guide::route;
  ObstacleTrackerParams tracker{};
  VelocityObstacleTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.directions, plain("directions", 3, 3600, "Number of directions to choose from."));
    visit(self.speeds, plain("speeds", 1, 100, "Number of speeds to choose from, besides 0."));
    visit(self.horizon,
          s("horizon", 0, 60, "Time for which a velocity must be free of obstacles."));
    visit(self.wall_horizon,
          s("wall_horizon", 0, 60, "Time for which a velocity must be free of walls."));
    visit(self.gap, um("gap", 0, 1e5, "Gap kept around the swarm.").formerly("margin_um"));
    visit(self.urgency,
          um("urgency", 0, 1e6, "Weight of 1 / time to contact where no velocity is free."));
    visit(self.guide, plain("guide", "Direction of the goal: straight or route."));
    visit(self.tracker, plain("tracker", "Estimation of the obstacles' motion."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
