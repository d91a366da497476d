// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/params.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm {

/// Task of a navigator.
struct Task {
  SwarmLimits swarm;                             ///< for a single-body swarm
  std::optional<RobotSwarmParams> robots;        ///< for individually tracked robots
  std::optional<Vec2> goal;                      ///< nothing if the robots have individual goals
  double goal_tolerance = 0;                     ///< [µm]
  double tick = 0.1;                             ///< between two commands [s]
  double frame_timeout = default_frame_timeout;  ///< age of a frame [s] at which it holds
};

/// Why the navigator cannot perform the task; empty if it can.
std::string_view unsupported_reason(const NavigatorParams& params, const Task& task);

/// Reports parameters of the navigator that are inconsistent or do not fit this swarm or map.
Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given = {});

/// Creates the navigator with these parameters, which must support the task.
std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task, Rng rng);

}  // namespace microswarm
