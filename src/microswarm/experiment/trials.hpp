// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "microswarm/experiment/run/run.hpp"

namespace microswarm {

/// One trial's outcome.
struct TrialResult {
  bool ran = false;  ///< false when the caller stopped before its turn
  std::string hash;  ///< of all that is physical, as Record::hash()
  RunResult result;
};

/// How to run many trials.
struct TrialOptions {
  int trials = 1;
  int jobs = 0;  ///< threads; 0 takes one a core
  /// Called after each trial, from any thread, one call at a time.
  std::function<void(int done, int trials)> progress;
  /// Changes the scenario of a trial before it runs: start, goal, obstacles (their motion too), but
  /// not the map. Must be pure.
  std::function<void(Scenario& scenario, std::uint32_t trial)> vary;
};

/// Runs trials 0 … n−1 of a scenario in one world, each with random streams of its own: the results
/// are the same bits for any number of threads. Wall-clock times are best measured with one job.
std::vector<TrialResult> run_trials(const Scenario& scenario, const World& world,
                                    const TrialOptions& options, const Stop& stop = {});

}  // namespace microswarm
