// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/exact.hpp"

#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"

namespace microswarm {

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ExactParams& params, Rng&,
          const Stop& stop) {
  Plan made{.path = {start.position}};
  if (const auto fault =
          query_fault(world, start.position, goal, params.goal_tolerance, params.clearance)) {
    made.status = *fault;
    return made;
  }
  if (distance(start.position, goal) <= params.goal_tolerance) {
    made.status = Status::solved;
    return made;
  }
  const Vec2 target = *free_goal(world, goal, params.goal_tolerance, params.clearance);
  ShortestPaths paths(world.map(), params.clearance);
  ShortestPath found = paths.find(start.position, target, world.moving(), stop);
  made.status = found.status;
  if (found.status == Status::solved) made.arc_length = found.length;
  made.path = std::move(found.points);
  made.counts.iterations = found.expanded;
  made.counts.edge_checks = found.checks;
  // A free place next to a blocked goal can be behind its wall.
  if (made.status == Status::no_path && distance(made.path.back(), goal) <= params.goal_tolerance)
    made.status = Status::solved;
  return made;
}

}  // namespace microswarm
