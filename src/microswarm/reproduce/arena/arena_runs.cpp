// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/arena/arena_runs.hpp"

#include <mutex>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/scenes/arena/arena.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"

namespace microswarm::reproduce {
std::vector<ArenaScene> run_arena(const std::vector<DrivenNavigator>& who,
                                  const ArenaExtent& extent,
                                  const std::function<void(double)>& progress, const Stop& stop) {
  const std::size_t all = scenes::arena_kinds().size();
  const std::size_t kinds = (all + extent.every - 1) / extent.every;
  std::vector<ArenaScene> out(kinds * extent.seeds);
  std::size_t done = 0;
  std::mutex mutex;
  for_each_index(out.size(), extent.threads, [&](std::size_t i) {
    if (stop()) return;
    ArenaScene& scene = out[i];
    scene.kind = extent.every * (i % kinds);
    scene.seed = extent.first + i / kinds;
    experiment::Scenario scenario = scenes::arena_scenario(scene.kind, scene.seed);
    const World world = scenes::avoidance_world(scenario);
    scene.optimum = find_optimum(scenario, world, stop);
    scene.shortest = planning::ShortestPaths(*world.map, 0)
                         .find(scenario.start->position, *scenario.goal)
                         .length -
                     scenario.goal_tolerance;
    const DrivenSwarm swarm{swarm_limits(scenario.swarm).max_speed,
                            scenes::arena_kinds()[scene.kind].clearance};
    for (const DrivenNavigator& navigator : who) {
      scenario.navigator = navigator.params(swarm);
      scene.runs.push_back(drive(scenario, world, stop));
    }
    scene.done = !stop();
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(++done) / static_cast<double>(out.size()));
  });
  return out;
}

}  // namespace microswarm::reproduce
