// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/navigator_state.hpp"
#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/status.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm::experiment {

/// State of an experiment at one time, as plain values for front ends.
struct SessionView {
  Frame frame{};                 ///< pose, radius, command, distances, state
  std::uint64_t number = 0;      ///< number of the frame, from 0
  std::optional<Status> end{};   ///< set for the last frame
  bool holding = false;          ///< whether the swarm is held at the goal
  std::vector<Body> bodies{};    ///< the obstacles at the frame's time
  std::vector<Vec2> robots{};    ///< positions [µm] of individually tracked robots
  std::vector<Vec2> path{};      ///< path followed by the navigator [µm]
  std::optional<Vec2> target{};  ///< local target of the navigator
  std::uint64_t plans = 0;       ///< number of planning events so far; it changes with the tree
  std::vector<TreeNode> tree{};  ///< of the newest plan
  std::vector<Detection> detections{};  ///< its detection circles [drrt]
  std::vector<RunEvent> events{};       ///< of the tick
};

/// View of a tick.
SessionView session_view(const Tick& tick, std::uint64_t number, std::uint64_t plans);

}  // namespace microswarm::experiment
