// SPDX-License-Identifier: Apache-2.0
// Figure 7 of [radar]: mean avoidance cost over the circles' radii.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/radar/radar.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr double swarm_radius = 100, planner_step = 25;  // r_s, d_p [px]
constexpr double min_fall = 1e-4;                        // minimum decrease that counts as falling

/// One series: varying radii of one circle with a fixed radius of the other [px]. The cases of Fig
/// 5 are ends of series. `rising_from` is the radius at which the cost begins to rise in the paper
/// (its point A).
struct RadarSweep {
  const char* name;
  const char* title;
  double first, last;
  std::optional<double> safety, detection;
  std::optional<double> cost_first, cost_last;
  double rising_from;
};

constexpr std::array<RadarSweep, 3> published_series{
    {{"series I", "series I: r_d varies, r_f = 150 px", 170, 350, 150, {}, 0.14, 0.18, 170},
     {"series II", "series II: r_f varies, r_d = 350 px", 150, 330, {}, 350, 0.18, 0.28, 170},
     {"series III", "series III: r_f varies, r_d = 250 px", 150, 230, {}, 250, {}, {}, 150}}};

/// Values measured at each radius.
struct SeriesCurve {
  std::vector<double> radius, cost;
  std::vector<int> side;
};

SeriesCurve measured(const RadarSweep& sweep, const RadarVersion& version,
                     const ReproduceOptions& options, const Stop& stop) {
  const double between = options.quick ? 20 : 10;
  SeriesCurve curve;
  for (double r = sweep.first; r <= sweep.last && !stop(); r += between) {
    RadarSetting s = load_radar(options, "single_printed.yaml", version);
    s.params().safety_distance = sweep.safety.value_or(r) - swarm_radius - planner_step;
    s.params().detection_range = sweep.detection.value_or(r) - swarm_radius;
    const RadarRun run = run_radar(s.scene, s.world, stop);
    curve.radius.push_back(r);
    curve.cost.push_back(run.record.result.metrics.avoidance.mean_cost);
    curve.side.push_back(side_passed(run.record));
  }
  return curve;
}

/// Ranks 0, 1, …; ties share their mean rank.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> out;
  for (const double v : values) {
    const auto less = std::count_if(values.begin(), values.end(), [v](double w) { return w < v; });
    const auto equal = std::count(values.begin(), values.end(), v);
    out.push_back(static_cast<double>(less) + 0.5 * static_cast<double>(equal - 1));
  }
  return out;
}

/// Spearman's rank correlation: 1 if y rises throughout with x, -1 if it falls. Empty for fewer
/// than two values.
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> a = ranks(x), b = ranks(y);
  const double mean = 0.5 * (static_cast<double>(a.size()) - 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  if (aa <= 0 || bb <= 0) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

/// The points from this radius on.
std::pair<std::vector<double>, std::vector<double>> from(const SeriesCurve& curve, double radius) {
  const auto k =
      std::lower_bound(curve.radius.begin(), curve.radius.end(), radius) - curve.radius.begin();
  return {{curve.radius.begin() + k, curve.radius.end()},
          {curve.cost.begin() + k, curve.cost.end()}};
}

/// Largest rise between adjacent radii relative to the total rise: near 1 for a step, small for a
/// slope.
std::optional<double> greatest_step(const std::vector<double>& y) {
  const double rise = y.back() - y.front();
  if (y.size() < 2 || rise <= 0) return std::nullopt;
  double most = 0;
  for (std::size_t i = 1; i < y.size(); ++i) most = std::max(most, y[i] - y[i - 1]);
  return most / rise;
}

void add_rows(const RadarSweep& sweep, const RadarVersion& version, const SeriesCurve& curve,
              std::vector<report::ReproduceRow>& rows) {
  const auto name = [&](const std::string& what) {
    return fmt::format("{}: {}", sweep.name, what);
  };
  const auto add = [&](double share, const std::string& what, const char* unit,
                       std::optional<double> paper, std::optional<double> ours) {
    rows.push_back(version_row(version, share, "fig7", name(what), unit, paper, ours));
  };
  add(near_cost, "mean cost at the smallest radius", "1", sweep.cost_first, curve.cost.front());
  add(near_cost, "mean cost at the greatest", "1", sweep.cost_last, curve.cost.back());
  const auto [x, y] = from(curve, sweep.rising_from);
  int rising = 0;
  for (std::size_t i = 1; i < y.size(); ++i) rising += y[i] > y[i - 1];
  const double steps = std::max<double>(1, static_cast<double>(y.size()) - 1);
  const std::string raise =
      name(fmt::format("steps between radii from {:g} px on that raise the cost, {}",
                       sweep.rising_from, version.name));
  const double share = 100.0 * rising / steps;
  rows.push_back(version.as_published ? row_at_least(0, "fig7", raise, "%", 100, share)
                                      : row_without_aim("not the paper's navigator", "fig7", raise,
                                                        "%", 100, share));
  add(0, "greatest of these steps in the whole rise", "1", {}, greatest_step(y));
  rows.push_back(
      row_without_aim("a single step makes it high, too", "fig7",
                      name(fmt::format("rank correlation of cost and radius, {}", version.name)),
                      "1", {}, rank_correlation(x, y)));
  if (sweep.rising_from > sweep.first) {
    const std::string what =
        fmt::format("cost falls up to {:g} px by, {}", sweep.rising_from, version.name);
    const double fall = curve.cost.front() - y.front();
    rows.push_back(
        version.as_published
            ? noted(make_row("fig7", name(what), "1", {}, fall, min_fall, false),
                    "the paper says that it falls, not by how much")
            : row_without_aim("not the paper's navigator", "fig7", name(what), "1", {}, fall));
  }
  const auto same = std::count(curve.side.begin(), curve.side.end(), curve.side.back());
  add(0, "runs that pass on the same side as the last", "%", {},
      100.0 * static_cast<double>(same) / static_cast<double>(curve.side.size()));
}

report::Plot draw_plot(const RadarSweep& sweep, const std::vector<SeriesCurve>& curves) {
  report::Series paper{.label = "paper: cases of Fig 5", .style = report::PlotStyle::published};
  if (sweep.cost_first) paper.x.push_back(sweep.first), paper.y.push_back(*sweep.cost_first);
  if (sweep.cost_last) paper.x.push_back(sweep.last), paper.y.push_back(*sweep.cost_last);
  report::Plot plot{.title = sweep.title,
                    .x_label = "radius (px)",
                    .y_label = "mean avoidance cost",
                    .key_below = true,
                    .x_min = sweep.first - 10,
                    .x_max = sweep.last + 10,
                    .y_min = 0,
                    .y_max = 0.35};
  for (std::size_t k = 0; k < curves.size(); ++k)
    plot.series.push_back({.label = radar_versions[k].name,
                           .x = curves[k].radius,
                           .y = curves[k].cost,
                           .style = report::PlotStyle::marked});
  plot.series.push_back(std::move(paper));
  return plot;
}

}  // namespace

std::vector<report::ReproduceRow> radar_series(const ReproduceOptions& options, const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  std::vector<report::Plot> plots;
  for (const RadarSweep& sweep : published_series) {
    std::vector<SeriesCurve> curves;
    for (const RadarVersion& version : radar_versions) {
      curves.push_back(measured(sweep, version, options, stop));
      if (stop()) return rows;
      add_rows(sweep, version, curves.back(), rows);
    }
    plots.push_back(draw_plot(sweep, curves));
  }
  if (!options.out.empty()) report::write_plots_everywhere(plots, fs::path(options.out) / "fig7");
  return rows;
}

}  // namespace microswarm::reproduce
