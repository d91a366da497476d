// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace microswarm::report {
namespace {

constexpr double max_ticks = 8;

/// The smallest step of 1, 2, 5, 10, … with at most `max_ticks` ticks up to `count`.
double whole_step(double count) {
  double power = 1;
  for (;;) {
    for (const double digit : {1.0, 2.0, 5.0})
      if (count / (digit * power) <= max_ticks) return digit * power;
    power *= 10;
  }
}

/// Integer ticks on the axis of events, with room at both ends.
void number_events(Plot& plot, double count) {
  const double step = whole_step(count);
  for (double at = step; at <= count; at += step)
    plot.x_ticks.push_back({fmt::format("{:.0f}", at), at});
  plot.x_min = 1 - 0.05 * count - 0.5;
  plot.x_max = count + 0.05 * count + 0.5;
}

Plot planning_times(const std::vector<double>& planning) {
  const experiment::TimeSummary sum = experiment::summarise(planning);
  Plot plot{.title = "Planning events",
            .x_label = "event",
            .y_label = "planning time (ms)",
            .key_below = true};
  Series each{.label = "each event", .style = PlotStyle::points};
  for (std::size_t i = 0; i < planning.size(); ++i) {
    each.x.push_back(static_cast<double>(i + 1));
    each.y.push_back(1e3 * planning[i]);
  }
  plot.series = {each};
  plot.levels = {
      {fmt::format("mean {:.3f} ms", 1e3 * sum.mean), 1e3 * sum.mean},
      {fmt::format("mean + sd {:.3f} ms", 1e3 * (sum.mean + sum.sd)), 1e3 * (sum.mean + sum.sd)}};
  plot.y_min = 0;
  number_events(plot, static_cast<double>(planning.size()));
  return plot;
}

Plot clearances(const experiment::Record& record) {
  const experiment::Scenario& scenario = record.scene.scenario;
  Plot plot{.title = "Clearance of the swarm's centre",
            .x_label = "time (s)",
            .y_label = "distance (µm)",
            .key_below = true};
  Series walls{.label = "walls and border"};
  Series bodies{.label = "moving obstacles"};
  for (const experiment::Frame& f : record.frames) {
    if (!std::isfinite(f.wall_clearance)) continue;  // the swarm has not been detected yet
    walls.x.push_back(f.t);
    walls.y.push_back(f.wall_clearance);
    if (!std::isfinite(f.obstacle_clearance)) continue;
    bodies.x.push_back(f.t);
    bodies.y.push_back(f.obstacle_clearance);
  }
  const double margin = navigation::required_clearance(scenario.navigator);
  const double radius = swarm_limits(scenario.swarm).radius;
  plot.levels = {{"swarm's radius", radius}};
  if (margin > 0) plot.levels.push_back({"navigator's margin", margin});
  plot.y_min = 0;
  // Limit the range to short distances; a run without any shows at least its minimum.
  const experiment::Metrics& m = record.result.metrics;
  const double nearest = std::min(m.walls.clearance, m.obstacles.clearance);
  plot.y_max = 5 * std::max(margin, radius);
  if (std::isfinite(nearest)) plot.y_max = std::max(*plot.y_max, 1.5 * nearest);
  for (const Series& series : {walls, bodies})  // omit lines above the range
    if (std::any_of(series.y.begin(), series.y.end(), [&](double y) { return y <= *plot.y_max; }))
      plot.series.push_back(series);
  return plot;
}

Plot avoidance_costs(const experiment::Record& record) {
  const double mean = record.result.metrics.avoidance.mean_cost;
  Plot plot{.title = "Avoidance cost",
            .x_label = "time (s)",
            .y_label = "δ (0: nothing avoided)",
            .key_below = true};
  Series cost{.label = "δ"};
  for (const experiment::Frame& f : record.frames) {
    cost.x.push_back(f.t);
    cost.y.push_back(f.avoidance_cost);
  }
  plot.series = {cost};
  plot.levels = {{fmt::format("mean {:.4g}", mean), mean}};
  plot.y_min = 0;
  const double most = *std::max_element(cost.y.begin(), cost.y.end());
  plot.y_max = most > 0 ? 1.1 * most : 1;
  return plot;
}

}  // namespace

std::vector<Plot> run_plots(const experiment::Record& record) {
  std::vector<Plot> plots;
  if (!record.result.timing.planning.empty())
    plots.push_back(planning_times(record.result.timing.planning));
  plots.push_back(clearances(record));
  if (!record.scene.scenario.obstacles.empty()) plots.push_back(avoidance_costs(record));
  return plots;
}

}  // namespace microswarm::report
