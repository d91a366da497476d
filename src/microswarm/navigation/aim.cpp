// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/aim.hpp"

#include "microswarm/planning/free_goal.hpp"

namespace microswarm {
namespace {

constexpr double inner_share = 0.9;   // of the tolerance: where a goal is aimed at by choice
constexpr double outer_share = 0.98;  // where it is not free nearer

}  // namespace

std::optional<Vec2> reachable_goal(const Snapshot& walls, Vec2 goal, double tolerance,
                                   double clearance) {
  if (const auto aim = free_goal(walls, goal, inner_share * tolerance, clearance)) return aim;
  return free_goal(walls, goal, outer_share * tolerance, clearance);
}

Vec2 aim_at(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted) {
  if (const auto aim = free_goal(walls, goal, inner_share * tolerance, wanted)) return *aim;
  return reachable_goal(walls, goal, tolerance, least).value_or(goal);
}

}  // namespace microswarm
