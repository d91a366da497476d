// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"
#include "microswarm/navigation/steering/guide_kind.hpp"

namespace microswarm {

/// Baseline: velocity obstacles (Fiorini and Shiller, IJRR 17, 1998), not reciprocal: of the
/// velocities on a grid of directions and speeds that meet nothing within the horizon, the one
/// nearest to the preferred one, which is at full speed to the target.
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
  ObstacleTrackerParams tracker;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Speed asked for."});
    visit(self.directions, {"directions", Unit::none, {3, 3600}, "Directions to choose from."});
    visit(self.speeds, {"speeds", Unit::none, {1, 100}, "Speeds to choose from, besides 0."});
    visit(self.horizon,
          {"horizon", Unit::s, {0, 60}, "Velocities that meet no obstacle for so long will do."});
    visit(self.wall_horizon,
          {"wall_horizon", Unit::s, {0, 60}, "Velocities that meet no wall for so long will do."});
    visit(self.gap, {"margin", Unit::um, {0, 1e5}, "Kept beside the swarm's edge."});
    visit(self.urgency,
          {"urgency",
           Unit::um,
           {0, 1e6},
           "Where no velocity will do: the least of urgency / time to contact + distance to the "
           "preferred velocity is taken."});
    visit(self.guide, {"guide", Unit::none, {}, "Direction of the goal: straight, or route."});
    visit(self.tracker, {"tracker", Unit::none, {}, "How the obstacles' motion is told."});
  }
};

}  // namespace microswarm
