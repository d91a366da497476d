// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_comparison.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "microswarm/config/write.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm::rig {

std::vector<ComparedTrial> compare_with_rig(const RigExperiment& on, int trials, int jobs,
                                            const std::function<void(double)>& progress,
                                            const Stop& stop) {
  const experiment::Scenario& scenario = on.scenario();
  const World& world = on.experiment.world;
  std::vector<std::optional<ComparedTrial>> results(static_cast<std::size_t>(trials));
  std::mutex mutex;
  int done = 0;
  for_each_index(results.size(), jobs, [&](std::size_t i) {
    const auto trial = static_cast<std::uint32_t>(i);
    if (stop()) return;
    auto rig = std::make_shared<SimulatedRig>(scenario, world, on.rig, trial);
    ComparedTrial both{
        static_cast<int>(i), experiment::simulate(scenario, world, {.trial = trial}, {}, stop),
        experiment::simulate(scenario, world, {.trial = trial, .plant = rig}, {}, stop)};
    if (stop()) return;
    both.fault = rig->fault();
    both.min_scale = rig->min_scale();
    both.notes = rig->take_notes();
    results[i] = std::move(both);
    const std::lock_guard lock(mutex);
    if (progress) progress(++done / static_cast<double>(trials));
  });
  std::vector<ComparedTrial> completed;
  for (std::optional<ComparedTrial>& both : results)
    if (both) completed.push_back(std::move(*both));
  return completed;
}

RunSummary summarise(std::span<const ComparedTrial> trials,
                     experiment::RunResult ComparedTrial::*plant) {
  RunSummary summary;
  std::vector<double> times;
  for (const ComparedTrial& both : trials) {
    const experiment::RunResult& result = both.*plant;
    summary.contacts += static_cast<int>(result.metrics.contacts);
    if (result.status == Status::solved) times.push_back(result.metrics.time);
  }
  summary.arrived = static_cast<int>(times.size());
  summary.are_same =
      trials.size() > 1 && std::ranges::all_of(trials, [&](const ComparedTrial& both) {
        const experiment::RunResult &one = both.*plant, &first = trials.front().*plant;
        return one.status == first.status && one.state == first.state &&
               to_json_text(one.metrics) == to_json_text(first.metrics);
      });
  summary.time = times.empty() ? std::numeric_limits<double>::quiet_NaN() : median(times);
  return summary;
}

std::vector<ComparisonRow> comparison_rows(std::span<const ComparedTrial> trials,
                                           const std::string& scenario,
                                           const std::string& settings) {
  std::vector<ComparisonRow> rows;
  for (const ComparedTrial& both : trials)
    for (const bool is_rig : {false, true}) {
      const experiment::RunResult& result = is_rig ? both.rig : both.kinematic;
      rows.push_back({.scenario = scenario,
                      .settings = settings,
                      .trial = both.trial,
                      .plant = is_rig ? "rig" : "kinematic",
                      .status = result.status,
                      .time = result.metrics.time,
                      .contacts = static_cast<int>(result.metrics.contacts),
                      .goal_distance = result.metrics.goal_distance,
                      .fault = is_rig ? both.fault : std::string()});
    }
  return rows;
}

}  // namespace microswarm::rig
