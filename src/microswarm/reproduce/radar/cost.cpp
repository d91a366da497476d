// SPDX-License-Identifier: Apache-2.0
// Fig 1(b) [radar]: avoidance cost of a deviation.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/radar/radar.hpp"

namespace microswarm::reproduce {
namespace {

constexpr double start_distance = 200;  // l_0 [pixels]

/// δ of Eq 4 [radar] for the deviation α [°] and l [pixels].
double cost(double deviation, double left) {
  return experiment::avoidance_cost({1, 0}, left, radians(deviation), true, start_distance);
}

struct PublishedCost {
  double deviation;  ///< α [°]
  double left;       ///< l [pixels]
  double cost;       ///< δ
};
constexpr std::array<PublishedCost, 2> published_costs{{{60, 100, 0.25}, {90, 130, 0.65}}};

void draw_costs(const std::filesystem::path& folder) {
  report::Plot plot{.title = "Avoidance cost",
                    .x_label = "deviation α (°)",
                    .y_label = "avoidance cost δ",
                    .key_below = true,
                    .y_min = 0};
  for (const double left : {50.0, 100.0, 130.0, 200.0}) {
    report::Series series{.label = fmt::format("l = {} pixels", left), .x = {}, .y = {}};
    for (double deviation = 0; deviation <= 180; deviation += 2) {
      series.x.push_back(deviation);
      series.y.push_back(cost(deviation, left));
    }
    plot.series.push_back(std::move(series));
  }
  for (std::size_t k = 0; k < published_costs.size(); ++k)
    plot.series.push_back({.label = k == 0 ? "published" : "",
                           .x = {published_costs[k].deviation},
                           .y = {published_costs[k].cost},
                           .style = report::PlotStyle::published,
                           .colour = k + 1});
  report::write_plots_everywhere({plot}, folder / "fig1");
}

}  // namespace

std::vector<report::ReproduceRow> radar_cost(const ReproduceOptions& options, const Stop&) {
  std::vector<report::ReproduceRow> rows;
  rows.reserve(published_costs.size());
  for (const PublishedCost& p : published_costs)
    rows.push_back(row_within(
        0.01, "fig1",
        fmt::format("δ at α = {}°, l = {} of {} pixels", p.deviation, p.left, start_distance), "1",
        p.cost, cost(p.deviation, p.left)));
  if (!options.out.empty()) draw_costs(options.out);
  return rows;
}

}  // namespace microswarm::reproduce
