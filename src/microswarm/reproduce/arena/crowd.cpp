// SPDX-License-Identifier: Apache-2.0
// Five people who walk across a circle and do not see the robot, 500 cases.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/arena/driven_run.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/scenes/orca_crowd.hpp"

namespace microswarm::reproduce {
namespace {

constexpr int all_cases = 500, quick_cases = 40;
constexpr double crowd_clearance = 42;  // of the robot of 30 µm [µm]
// Published for SARL with an invisible robot, as later papers cite it.
constexpr double published_sarl = 100;  // crossed [%]

std::vector<std::optional<double>> crowd_optima(int cases, const ReproduceOptions& options,
                                                const Stop& stop) {
  const Progress bar(options.progress, "crowd: earliest arrivals");
  std::vector<std::optional<double>> optima(static_cast<std::size_t>(cases));
  for_each_index(optima.size(), 0, [&](std::size_t i) {
    if (stop()) return;
    const experiment::Scenario s = scenes::orca_crowd_scenario(i + 1);
    optima[i] = find_optimum(s, scenes::avoidance_world(s), stop);
  });
  return optima;
}

std::vector<report::ReproduceRow> crowd_crossing(const ReproduceOptions& options,
                                                 const Stop& stop) {
  const int cases = options.quick ? quick_cases : all_cases;
  const std::vector<std::optional<double>> optima = crowd_optima(cases, options, stop);
  std::vector<report::ReproduceRow> rows;
  const auto add = [&](report::ReproduceRow row, std::string_view note) {
    rows.push_back(unjudged_if_quick(noted(std::move(row), note), options));
  };
  for (const DrivenNavigator& navigator : driven_navigators()) {
    const Progress bar(options.progress, fmt::format("crowd: {}", navigator.name));
    std::vector<DrivenRun> runs(static_cast<std::size_t>(cases));
    for_each_index(runs.size(), 0, [&](std::size_t i) {
      if (stop()) return;
      experiment::Scenario s = scenes::orca_crowd_scenario(i + 1);
      s.navigator = navigator.params({swarm_limits(s.swarm).max_speed, crowd_clearance});
      runs[i] = drive(s, scenes::avoidance_world(s), stop);
    });
    if (stop()) return rows;
    int crossed = 0, avoidable = 0;
    std::vector<double> times, over_optimum;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      avoidable += runs[i].avoidable > 0;
      if (!runs[i].arrived()) continue;
      ++crossed;
      times.push_back(runs[i].time);
      if (optima[i]) over_optimum.push_back(runs[i].time / *optima[i]);
    }
    const auto named = [&](const char* what) {
      return fmt::format("{}: {}", navigator.name, what);
    };
    const auto aim = [&](double value) {
      return navigator.is_recommended ? std::optional(value) : std::nullopt;
    };
    add(make_row("crowd", named("crossed"), "%", aim(published_sarl), 100.0 * crossed / cases,
                 aim(100), false),
        share_text(crossed, cases) +
            (navigator.is_recommended ? "; published at second hand: 99 to 100 (SARL), 43 (ORCA)"
                                      : ""));
    add(make_row("crowd", named("avoidable contact"), "%", {}, 100.0 * avoidable / cases, aim(0)),
        share_text(avoidable, cases));
    add(make_row("crowd", named("time, mean"), "s", {},
                 times.empty() ? std::nullopt : std::optional(mean(times))),
        "of those that arrive");
    add(make_row("crowd", named("time over the optimum, median"), "", {},
                 median_if_any(over_optimum), aim(1.05)),
        "");
  }
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> crowd_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop) {
  constexpr Figure figures[] = {{"all", crowd_crossing}};
  return reproduce_figures("crowd", figures, figure, options, stop);
}

}  // namespace microswarm::reproduce
