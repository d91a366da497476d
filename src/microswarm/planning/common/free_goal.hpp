// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/plan.hpp"

namespace microswarm::planning {

/// The goal if it is free with the clearance, else approximately the nearest free point within
/// `tolerance` [µm]. A free spot smaller than tolerance / 64 is found only by moving from its
/// surroundings along the clearance gradient, so one between several walls may be missed.
std::optional<Vec2> free_goal(const Snapshot& world, Vec2 goal, double tolerance, double clearance);

/// A place with the clearance beside one that has less, against the walls' push; nothing in a wall
/// and where there is none nearby.
std::optional<Vec2> pushed_free(const Map& map, Vec2 position, double clearance);

/// A free place at the goal of a query, or why it cannot be planned: start_blocked or goal_blocked.
struct Target {
  std::optional<Status> fault{};
  Vec2 position{};
  /// The plan of a query with a fault.
  Plan blocked(Vec2 start) const { return {.status = *fault, .path = {start}}; }
};
Target find_target(const Snapshot& world, Vec2 start, Vec2 goal, double tolerance,
                   double clearance);

}  // namespace microswarm::planning
