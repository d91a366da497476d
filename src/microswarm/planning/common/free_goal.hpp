// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

/// The places at which a goal counts as reached: within the tolerance [µm], and without a wall
/// between. If the goal itself is in a wall, the distance alone counts.
class GoalArea {
 public:
  /// The map must outlive the area.
  GoalArea(const Map& map, Vec2 goal, double tolerance)
      : map_(&map), goal_(goal), tolerance_(tolerance), in_wall_(!map.is_free(goal, 0)) {}

  bool contains(Vec2 p) const {
    return distance(p, goal_) <= tolerance_ && (in_wall_ || map_->is_free(Segment{p, goal_}, 0));
  }

 private:
  const Map* map_;
  Vec2 goal_;
  double tolerance_;
  bool in_wall_;
};

/// The goal if it is free with the clearance, else approximately the nearest free point of its
/// area. A free spot smaller than tolerance / 64 is found only by moving from its
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
