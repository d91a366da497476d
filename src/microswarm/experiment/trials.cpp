// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/trials.hpp"

#include <mutex>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

namespace {

TrialResult run_trial(const Scene& scene, const World& world, std::uint32_t trial,
                      const TrialOptions& options, const Stop& stop) {
  Recorder recorder(scene, trial);
  Scenario scenario = scene.scenario;
  World varied = world;
  if (options.vary) {
    options.vary(scenario, trial);
    varied.obstacles = scenario.obstacles;
  }
  RunListener* const listeners[] = {&recorder};
  RunResult result = simulate(scenario, varied, trial, listeners, stop);
  TrialResult outcome{.ran = true, .hash = recorder.record().hash(), .result = std::move(result)};
  return outcome;
}

}  // namespace

std::vector<TrialResult> run_trials(const Scenario& scenario, const World& world,
                                    const TrialOptions& options, const Stop& stop) {
  std::vector<TrialResult> results(static_cast<std::size_t>(options.trials));
  const Scene scene{scenario, {}};
  std::mutex mutex;
  int done = 0;
  for_each_index(results.size(), options.jobs, [&](std::size_t i) {
    if (stop()) return;
    TrialResult trial = run_trial(scene, world, static_cast<std::uint32_t>(i), options, stop);
    if (trial.result.status == Status::stopped) return;  // an interrupted trial does not count
    results[i] = std::move(trial);
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done, options.trials);
  });
  return results;
}

}  // namespace microswarm
