// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/run.hpp"

#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/plant/robot_plant.hpp"
#include "microswarm/experiment/run/episode.hpp"
#include "microswarm/experiment/run/metrics_listener.hpp"
#include "microswarm/experiment/run/open_run.hpp"

namespace microswarm {

RunResult run(const Scenario& scenario, const std::function<const Tick*()>& step,
              std::span<RunListener* const> listeners) {
  MetricsListener metrics(scenario);
  while (const Tick* tick = step()) {
    metrics.on_tick(*tick);
    for (RunListener* listener : listeners) listener->on_tick(*tick);
  }
  for (RunListener* listener : listeners) listener->on_end(metrics.result());
  return metrics.result();
}

RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
              std::span<RunListener* const> listeners, const Stop& stop) {
  Episode episode(scenario, plant, navigator);
  return run(
      scenario, [&] { return episode.step(stop); }, listeners);
}

std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial) {
  if (scenario.robots) return std::make_unique<RobotPlant>(scenario, world, trial);
  return std::make_unique<KinematicPlant>(scenario, world, trial);
}

RunResult simulate(const Scenario& scenario, const World& world, std::uint32_t trial,
                   std::span<RunListener* const> listeners, const Stop& stop) {
  OpenRun open(scenario, world, trial);
  return open.finish(listeners, stop);
}

}  // namespace microswarm
