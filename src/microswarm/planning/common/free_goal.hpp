// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// The goal if it is free with the clearance, else approximately the nearest free point within
/// `tolerance` [µm]. A free spot smaller than tolerance / 64 is found only by moving from its
/// surroundings along the clearance gradient, so one between several walls may be missed.
std::optional<Vec2> free_goal(const Snapshot& world, Vec2 goal, double tolerance, double clearance);

/// Fault of a query before planning: start_blocked, goal_blocked or nothing.
std::optional<Status> query_fault(const Snapshot& world, Vec2 start, Vec2 goal, double tolerance,
                                  double clearance);

}  // namespace microswarm
