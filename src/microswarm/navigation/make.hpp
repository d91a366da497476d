// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/issue.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/navigation/params.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"

namespace microswarm {

/// What a navigator is told of its task.
struct Task {
  SwarmLimits swarm;                       ///< of a swarm that is seen as one body
  std::optional<RobotSwarmParams> robots;  ///< of one whose robots are told apart
  std::optional<Vec2> goal;                ///< nothing when the robots have goals of their own
  double goal_tolerance = 0;               ///< [µm]
  double tick = 0.1;                       ///< between two commands [s]
  double frame_timeout = default_frame_timeout;  ///< age of a frame [s] at which it holds
};

/// What a navigator can steer: nothing when it can do the task, else what it lacks.
std::string_view unsupported_reason(const NavigatorParams& params, const Task& task);

/// Issues when the navigator's parameters make no sense together, for this swarm or on this map.
Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given = {});

/// The navigator with these parameters; it lacks nothing for the task.
std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task, Rng rng);

}  // namespace microswarm
