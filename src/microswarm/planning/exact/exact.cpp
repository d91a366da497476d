// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/exact.hpp"

#include <memory>
#include <utility>

#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/world/map/kept_work.hpp"

namespace microswarm::planning {
namespace {

/// Finds the shortest path with the tangents kept from earlier queries.
ShortestPath find_kept(const Snapshot& world, double clearance, Vec2 start, Vec2 goal,
                       const Stop& stop) {
  constexpr std::size_t max_bytes = 256u << 20;
  const Map& map = world.map();
  auto paths = map.kept().take<ShortestPaths>(clearance);
  if (paths)
    paths->use(map);
  else
    paths = std::make_unique<ShortestPaths>(map, clearance);
  ShortestPath found = paths->find(start, goal, world.moving(), stop);
  if (paths->bytes() <= max_bytes) map.kept().keep(clearance, std::move(paths));
  return found;
}

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ExactParams& params, Rng&,
          const Stop& stop) {
  const Target target =
      find_target(world, start.position, goal, params.goal_tolerance, params.clearance);
  if (target.fault) return target.blocked(start.position);
  Plan made{.status = Status::solved, .path = {start.position}};
  const GoalArea area(world.map(), goal, params.goal_tolerance);
  if (area.contains(start.position)) return made;
  ShortestPath found = find_kept(world, params.clearance, start.position, target.position, stop);
  made.status = found.status;
  if (found.status == Status::solved) made.arc_length = found.length;
  made.path = std::move(found.points);
  made.counts.iterations = found.expanded;
  made.counts.edge_checks = found.lines;
  // The free point next to a blocked goal can lie in a pocket.
  if (made.status == Status::no_path && area.contains(made.path.back()))
    made.status = Status::solved;
  return made;
}

}  // namespace microswarm::planning
