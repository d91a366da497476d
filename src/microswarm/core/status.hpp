// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

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

/// The status in one word with underscores, as in records and JSON.
std::string_view to_string(Status status);

}  // namespace microswarm
