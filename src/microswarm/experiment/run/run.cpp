// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/run.hpp"

#include "microswarm/experiment/run/episode.hpp"
#include "microswarm/experiment/run/metrics_listener.hpp"
#include "microswarm/experiment/run/plant.hpp"
#include "microswarm/experiment/run/robot_plant.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/navigation/make.hpp"

namespace microswarm {

RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
              std::span<RunListener* const> listeners, const Stop& stop) {
  Episode episode(scenario, plant, navigator);
  MetricsListener metrics(scenario);
  while (const Tick* tick = episode.step(stop)) {
    metrics.on_tick(*tick);
    for (RunListener* listener : listeners) listener->on_tick(*tick);
  }
  for (RunListener* listener : listeners) listener->on_end(metrics.result());
  return metrics.result();
}

std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial) {
  if (scenario.robots) return std::make_unique<RobotPlant>(scenario, world, trial);
  return std::make_unique<KinematicPlant>(scenario, world, trial);
}

RunResult simulate(const Scenario& scenario, const World& world, std::uint32_t trial,
                   std::span<RunListener* const> listeners, const Stop& stop) {
  const std::unique_ptr<Plant> plant = make_kinematic_plant(scenario, world, trial);
  const auto navigator = make_navigator(scenario.navigator, task_of(scenario),
                                        Rng(scenario.seed, Purpose::planner, trial));
  return run(scenario, *plant, *navigator, listeners, stop);
}

}  // namespace microswarm
