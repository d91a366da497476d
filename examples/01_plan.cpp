// SPDX-License-Identifier: Apache-2.0
// A path around a wall by D-RRT*.
#include <cstdio>

#include "microswarm/planning/path/fit_to_map.hpp"
#include "microswarm/planning/path/planners.hpp"

int main() {
  using namespace microswarm;
  const Polygon wall{.outer = {{900, 0}, {1000, 0}, {1000, 600}, {900, 600}}, .holes = {}};
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, std::vector{wall});
  const Snapshot world(map);

  planning::DrrtStarParams params;
  params.clearance = 60;  // µm, from the swarm's centre
  const auto is_given = [](std::string_view key) { return key == "clearance_um"; };
  const planning::PlannerParams fitted =
      planning::fit_to_map(params, *map, is_given);  // steps, radii and limits
  Rng rng(42, Purpose::planner);
  const Plan found = planning::plan(world, {{200, 300}, 0}, {1800, 300}, fitted, rng);

  std::printf("%s: %.0f µm in %zu points, %zu nodes\n", to_string(found.status).data(),
              path_length(found.path), found.path.size(), found.tree.size());
  for (const Vec2 p : found.path) std::printf("%.1f,%.1f\n", p.x, p.y);
  return found.status == Status::solved ? 0 : 1;
}
