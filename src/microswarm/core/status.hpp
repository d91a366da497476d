// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// Why a planner or a run ended. Expected outcomes are values, never exceptions; each comes with
/// the best partial result.
enum class Status {
  solved,         ///< planner: a path to the goal; run: the goal was reached
  no_path,        ///< the search space is exhausted: there is none
  node_limit,     ///< nodes or iterations ran out before a path was found
  time_limit,     ///< run: the simulated time ran out; planner: its deadline passed
  stopped,        ///< the caller asked to stop
  start_blocked,  ///< the start is not free with the clearance asked for
  goal_blocked,   ///< no point within the goal tolerance is free
  held,           ///< run: the swarm held where it was until the end, nothing was safe
  collided,       ///< run: the swarm touched an obstacle or a wall
  fault,          ///< run: the plant could not go on, as a rig that lost its swarm
};
constexpr auto enum_names(Status) {
  return std::array<std::pair<Status, std::string_view>, 10>{
      {{Status::solved, "solved"},
       {Status::no_path, "no_path"},
       {Status::node_limit, "node_limit"},
       {Status::time_limit, "time_limit"},
       {Status::stopped, "stopped"},
       {Status::start_blocked, "start_blocked"},
       {Status::goal_blocked, "goal_blocked"},
       {Status::held, "held"},
       {Status::collided, "collided"},
       {Status::fault, "fault"}}};
}

/// The status in one word with underscores, as in records and JSON.
constexpr std::string_view to_string(Status status) { return enum_name(status); }

}  // namespace microswarm
