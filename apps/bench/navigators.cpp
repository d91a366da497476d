// SPDX-License-Identifier: Apache-2.0
#include "bench/navigators.hpp"

#include <optional>
#include <string>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/arena/arena_runs.hpp"

namespace microswarm::bench {
namespace {

constexpr reproduce::ArenaExtent every_kind{.seeds = 1, .threads = 1};
constexpr reproduce::ArenaExtent quick_kinds{.seeds = 1, .every = 10, .threads = 1};
constexpr double milliseconds = 1e3;

/// Results of one navigator in all scenes.
struct Results {
  std::vector<double> arrived, over_optimum, step_p50, step_p99;  ///< [%], [1], [ms], [ms]
};

Results of_navigator(const std::vector<reproduce::ArenaScene>& scenes, std::size_t k) {
  Results results;
  for (const reproduce::ArenaScene& scene : scenes) {
    if (!scene.done) continue;
    const reproduce::DrivenRun& run = scene.runs[k];
    results.arrived.push_back(run.arrived() ? 100 : 0);
    if (!run.ran) continue;
    results.step_p50.push_back(milliseconds * run.step_p50);
    results.step_p99.push_back(milliseconds * run.step_p99);
    if (scene.optimum && run.arrived()) results.over_optimum.push_back(run.time / *scene.optimum);
  }
  return results;
}

}  // namespace

std::vector<report::BenchRow> navigators(bool quick, const Stop& stop) {
  const std::vector<reproduce::DrivenNavigator> who = reproduce::driven_navigators();
  const std::vector<reproduce::ArenaScene> scenes = reproduce::run_arena(
      who, quick ? quick_kinds : every_kind, [](double) {}, stop);
  std::vector<report::BenchRow> rows;
  for (std::size_t k = 0; k < who.size(); ++k) {
    const auto add = [&](const char* quantity, const char* unit, double ours, double aim,
                         bool at_most = true) {
      report::BenchRow row{.name = who[k].name,
                           .quantity = quantity,
                           .unit = unit,
                           .ours = ours,
                           .at_most = at_most};
      if (who[k].is_recommended) row.aim = aim;
      rows.push_back(std::move(row));
    };
    const Results results = of_navigator(scenes, k);
    if (!results.arrived.empty()) add("arrived", "%", mean(results.arrived), 99, false);
    if (!results.over_optimum.empty())
      add("times the optimum, median of the arrivals", "1", median(results.over_optimum), 1.02);
    if (results.step_p50.empty()) continue;
    add("time of a decision, p50, median of the runs", "ms", median(results.step_p50), 2);
    add("time of a decision, p99, median of the runs", "ms", median(results.step_p99), 10);
  }
  return rows;
}

}  // namespace microswarm::bench
