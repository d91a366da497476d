// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/aim.hpp"

#include <algorithm>

#include "microswarm/planning/common/free_goal.hpp"

namespace microswarm::navigation {

std::optional<Vec2> reachable_goal(const Snapshot& walls, Vec2 goal, double tolerance,
                                   double clearance) {
  return planning::free_goal(walls, goal, aim_share * tolerance, clearance);
}

namespace {

Vec2 aim_position(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted) {
  if (const auto aim = reachable_goal(walls, goal, tolerance, wanted)) return *aim;
  if (!reachable_goal(walls, goal, tolerance, least)) return goal;
  constexpr int halvings = 8;
  double enough = least;
  double too_much = wanted;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (enough + too_much);
    (reachable_goal(walls, goal, tolerance, middle) ? enough : too_much) = middle;
  }
  return reachable_goal(walls, goal, tolerance, 0.5 * (least + enough)).value_or(goal);
}

}  // namespace

Aim aim_at(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted) {
  const Vec2 position = aim_position(walls, goal, tolerance, least, wanted);
  return {position, walls.map().clearance(position), tolerance - distance(position, goal)};
}

double Aim::wall_clearance(double least, double wanted, Vec2 p, double reach) const {
  constexpr double rounding = 1e-9;
  if (clearance >= wanted || distance(p, position) > reach + wanted) return wanted;
  return std::max(least, (1 - rounding) * clearance);
}

}  // namespace microswarm::navigation
