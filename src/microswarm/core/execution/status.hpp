// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// Why a planner or a run ended. Expected outcomes are values, never exceptions; each comes with
/// the best partial result.
enum class Status {
  solved,         ///< planner: path to the goal found; run: goal reached
  no_path,        ///< search space exhausted without a path
  node_limit,     ///< nodes or iterations ran out before a path was found
  time_limit,     ///< run: simulated time ran out; planner: deadline passed
  stopped,        ///< the caller asked to stop
  start_blocked,  ///< the start lacks the required clearance
  goal_blocked,   ///< no point within the goal tolerance is free
  held,           ///< run: the swarm held its position until the end because no motion was safe
  collided,       ///< run: the swarm touched an obstacle or a wall
  fault,          ///< run: the plant failed, e.g. a rig lost its swarm
  running,        ///< run: it has not ended yet
};
constexpr auto enum_names(Status) {
  return std::array<std::pair<Status, std::string_view>, 11>{
      {{Status::solved, "solved"},
       {Status::no_path, "no_path"},
       {Status::node_limit, "node_limit"},
       {Status::time_limit, "time_limit"},
       {Status::stopped, "stopped"},
       {Status::start_blocked, "start_blocked"},
       {Status::goal_blocked, "goal_blocked"},
       {Status::held, "held"},
       {Status::collided, "collided"},
       {Status::fault, "fault"},
       {Status::running, "running"}}};
}

/// The status in one word with underscores, as in records and JSON.
constexpr std::string_view to_string(Status status) { return enum_name(status); }

}  // namespace microswarm
