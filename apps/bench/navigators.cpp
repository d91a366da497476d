// SPDX-License-Identifier: Apache-2.0
#include "bench/navigators.hpp"

#include <optional>
#include <string>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/arena/arena_runs.hpp"

namespace microswarm::bench {
namespace {

constexpr reproduce::ArenaExtent every_kind{.seeds = 1};
constexpr reproduce::ArenaExtent quick_kinds{.seeds = 1, .every = 10};
constexpr double milliseconds = 1e3;

/// Results of one navigator in all scenes.
struct Results {
  std::vector<double> over_optimum, step_p50, step_p99;  ///< [1], [ms], [ms]
};

Results of_navigator(const std::vector<reproduce::ArenaScene>& scenes, std::size_t k) {
  Results results;
  for (const reproduce::ArenaScene& scene : scenes) {
    if (!scene.done || !scene.runs[k].ran) continue;
    const reproduce::DrivenRun& run = scene.runs[k];
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
    const auto add = [&](const char* quantity, const char* unit, const std::vector<double>& values,
                         double aim) {
      if (values.empty()) return;
      report::BenchRow row{
          .name = who[k].name, .quantity = quantity, .unit = unit, .ours = median(values)};
      if (who[k].is_recommended) row.aim = aim;
      rows.push_back(std::move(row));
    };
    const Results results = of_navigator(scenes, k);
    add("times the optimum, median of the arrivals", "1", results.over_optimum, 1.02);
    add("time of a decision, p50, median of the runs", "ms", results.step_p50, 2);
    add("time of a decision, p99, median of the runs", "ms", results.step_p99, 10);
  }
  return rows;
}

}  // namespace microswarm::bench
