// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "microswarm/core/execution/mutex.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::experiment {

TrialResult trial_result(Scenario scenario, World world, std::uint32_t trial, const Stop& stop) {
  Session session({{std::move(scenario), {}}, std::move(world), {}}, {.trial = trial});
  session.finish(stop);
  return {.ran = true, .hash = session.record().hash(), .result = session.result()};
}

std::vector<TrialResult> run_trials(const Scenario& scenario, const World& world,
                                    const TrialOptions& options, const Stop& stop) {
  std::vector<TrialResult> results(static_cast<std::size_t>(options.trials));
  Mutex mutex;
  int done = 0;
  for_each_index(results.size(), options.jobs, [&](std::size_t i) {
    if (stop()) return;
    const auto number = static_cast<std::uint32_t>(i);
    Scenario varied = scenario;
    World there = world;
    if (options.vary) {
      options.vary(varied, number);
      there.obstacles = varied.obstacles;
    }
    TrialResult trial = trial_result(std::move(varied), std::move(there), number, stop);
    if (trial.result.status == Status::stopped) return;  // an interrupted trial does not count
    results[i] = std::move(trial);
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done, options.trials);
  });
  return results;
}

std::string same_run_note(std::span<const std::string> hashes) {
  if (hashes.size() < 2 ||
      std::ranges::adjacent_find(hashes, std::not_equal_to<>()) != hashes.end())
    return {};
  return fmt::format(
      "all {} trials are the same run, record {}: nothing here is random, count them as one",
      hashes.size(), hashes.front());
}

}  // namespace microswarm::experiment
