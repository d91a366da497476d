// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/aim.hpp"

#include "microswarm/planning/free_goal.hpp"

namespace microswarm {

std::optional<Vec2> reachable_goal(const Snapshot& walls, Vec2 goal, double tolerance,
                                   double clearance) {
  return free_goal(walls, goal, aim_share * tolerance, clearance);
}

Vec2 aim_at(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted) {
  if (const auto aim = reachable_goal(walls, goal, tolerance, wanted)) return *aim;
  return reachable_goal(walls, goal, tolerance, least).value_or(goal);
}

}  // namespace microswarm
