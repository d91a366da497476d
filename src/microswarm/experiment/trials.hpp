// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Result of one trial.
struct TrialResult {
  bool ran = false;    ///< false if the caller stopped before it
  std::string hash{};  ///< see Record::hash()
  RunResult result{};
};

/// Runs one trial to its end.
TrialResult trial_result(Scenario scenario, World world, std::uint32_t trial,
                         const Stop& stop = {});

/// Settings of `run_trials`.
struct TrialOptions {
  int trials = 1;
  int jobs = 0;  ///< threads; 0: one per core
  /// Called after each trial, from any thread, one call at a time.
  std::function<void(int done, int trials)> progress{};
  /// Changes the scenario of a trial before it runs: start, goal, obstacles and their motion, but
  /// not the map. Must be a pure function.
  std::function<void(Scenario& scenario, std::uint32_t trial)> vary{};
};

/// Runs trials 0 … n−1 of a scenario in one world, each with its own random streams. The results
/// are bit-identical for any number of threads. Use one job to measure wall-clock times.
std::vector<TrialResult> run_trials(const Scenario& scenario, const World& world,
                                    const TrialOptions& options, const Stop& stop = {});

/// One line if all trials are the same run, given the hashes of their records, so that nobody
/// counts them as several. Empty if two differ, or there are fewer than two.
std::string same_run_note(std::span<const std::string> hashes);

}  // namespace microswarm::experiment
