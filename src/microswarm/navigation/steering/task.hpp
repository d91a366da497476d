// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm::navigation {

/// Task of a navigator.
struct Task {
  SwarmLimits swarm{};                           ///< for a single-body swarm
  std::optional<RobotSwarmParams> robots{};      ///< for individually tracked robots
  std::optional<Vec2> goal{};                    ///< nothing if the robots have individual goals
  double goal_tolerance = 0;                     ///< [µm]
  double tick = 0.1;                             ///< between two commands [s]
  double frame_timeout = default_frame_timeout;  ///< age of a frame [s] at which it holds
};

}  // namespace microswarm::navigation
