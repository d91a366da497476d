// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/reproduce/gather/gather.hpp"

namespace microswarm::reproduce {
namespace {

// Fig 7: predicted time over ξ, the fraction of the map that remains after one region, by the two
// recurrence models, compared with steps of DCA on maps with decreasing numbers of regions.

constexpr int robots_measured = 1024;
constexpr double map_area = 100;  // m of the printed curves, in areas of the base case

/// Eq 9 [gather] divided by kρm²: the map shrinks repeatedly by the factor ξ.
double by_factor(double xi, double m) {
  const int levels = static_cast<int>(std::floor(maths::log(m) / maths::log(1 / xi)));
  double sum = 0;
  for (int i = 0; i <= levels; ++i) sum += maths::power(xi, 2 * i);
  return (1 - xi) * (1 - xi) * sum;
}
/// Eq 10
double by_factor_smooth(double xi) { return 2 / (1 + xi) - 1; }
/// Eq 12: the map shrinks by equal areas.
double by_area(double xi) {
  return (1 - xi) * (1 - xi) * (1 + std::floor(1 / (1 - xi) * (1 + 1e-12)));
}
/// Eq 13
double by_area_smooth(double xi) { return (1 - xi) * (2 - xi); }

/// ξ of a map divided into regions of equal size.
double model_xi(std::size_t regions) { return 1 - 1 / static_cast<double>(regions); }

/// Merges the smallest region into its successor until `regions` remain.
planning::MapSegmentation coarsened(planning::MapSegmentation map,
                                    const planning::ObstacleWeightedRrt& tree,
                                    std::size_t regions) {
  while (map.regions.size() > regions) {
    std::vector<std::size_t> nodes(map.regions.size(), 0);
    for (const std::uint32_t r : map.region) ++nodes[r];
    const auto smallest = static_cast<std::uint32_t>(
        std::min_element(nodes.begin() + 1, nodes.end()) - nodes.begin());
    const Region gone = map.regions[smallest];
    const std::uint32_t branch = map.branch[tree.weighted.next[gone.gate]];
    for (std::size_t v = 0; v < map.region.size(); ++v) {
      if (map.region[v] == smallest) {
        map.region[v] = gone.next;
        map.branch[v] = branch;
      }
      if (map.region[v] > smallest) --map.region[v];
    }
    map.regions.erase(map.regions.begin() + smallest);
    for (Region& region : map.regions) {
      if (region.next == smallest) region.next = gone.next;
      if (region.next > smallest) --region.next;
    }
  }
  return map;
}

struct Measured {
  std::vector<double> xi;
  std::vector<double> steps;
  std::vector<std::size_t> regions;
};

double mean_steps(const scenes::Vascular& scene, const navigation::AggregationMap& map, int trials,
                  const Stop& stop) {
  const RobotStepper stepper(map.map, 1);
  std::vector<double> steps(static_cast<std::size_t>(trials));
  for_each_index(steps.size(), 0, [&](std::size_t i) {
    Robots robots =
        gather_robots(scene, map, stepper, robots_measured, static_cast<std::uint32_t>(i), 0);
    navigation::AggregationPolicy policy(
        map, gather_params(scene, navigation::Aggregation::divide_and_conquer));
    steps[i] = navigation::gather(stepper, policy, robots, gather_most_steps, stop).steps;
  });
  return std::accumulate(steps.begin(), steps.end(), 0.0) / trials;
}

Measured measured(const scenes::Vascular& scene, int trials, const Stop& stop) {
  const navigation::AggregationMap whole = gather_map(scene, true);
  const std::size_t all = whole.segmentation.regions.size();
  Measured out;
  for (const std::size_t regions : {1, 2, 3, 5, 7, 9, 13, 18, 24, 31}) {
    if (regions > all) break;
    navigation::AggregationMap map = whole;
    map.segmentation = coarsened(whole.segmentation, whole.tree, regions);
    out.regions.push_back(regions);
    out.xi.push_back(model_xi(regions));
    out.steps.push_back(mean_steps(scene, map, trials, stop));
  }
  return out;
}

/// The model's unit kρm², by least squares.
double fitted_unit(const Measured& m, double (*model)(double)) {
  double product = 0;
  double square = 0;
  for (std::size_t i = 0; i < m.xi.size(); ++i) {
    product += m.steps[i] * model(m.xi[i]);
    square += model(m.xi[i]) * model(m.xi[i]);
  }
  return product / std::max(square, 1e-12);
}

template <class Model>
report::Series curve(std::string label, Model&& model, double from, double to, int points = 200,
                     report::PlotStyle style = report::PlotStyle::line) {
  report::Series series{.label = std::move(label), .style = style};
  for (int i = 0; i <= points; ++i) {
    series.x.push_back(from + (to - from) * i / points);
    series.y.push_back(model(series.x.back()));
  }
  return series;
}

report::Plot plot_of_models() {
  report::Plot plot{.title = "models", .x_label = "ξ", .y_label = "T / (k ρ m^2)", .y_min = 0};
  plot.y_max = 2.1;
  plot.key_below = true;
  constexpr int rings = 40;  // over the nearly coinciding curves
  plot.series.push_back(curve("Eq 10", by_factor_smooth, 0.01, 0.99));
  plot.series.push_back(curve("Eq 13", by_area_smooth, 0.01, 0.99));
  plot.series.push_back(curve(
      "Eq 9, m = 100", [](double xi) { return by_factor(xi, map_area); }, 0.01, 0.99, rings,
      report::PlotStyle::rings));
  plot.series.push_back(curve("Eq 12", by_area, 0.01, 0.99, rings, report::PlotStyle::rings));
  return plot;
}

report::Plot draw_plot(const std::string& name, const Measured& m) {
  report::Plot plot{
      .title = name, .x_label = "ξ = 1 - 1 / regions", .y_label = "steps", .y_min = 0};
  const double by_area_unit = fitted_unit(m, by_area_smooth);
  const double by_factor_unit = fitted_unit(m, by_factor_smooth);
  const double last = m.xi.back();
  plot.series.push_back({.label = "DCA, n = 1024", .x = m.xi, .y = m.steps});
  plot.series.push_back(curve(
      "Eq 10, fitted", [&](double xi) { return by_factor_unit * by_factor_smooth(xi); }, 0, last));
  plot.series.push_back(curve(
      "Eq 13, fitted", [&](double xi) { return by_area_unit * by_area_smooth(xi); }, 0, last));
  plot.key_below = true;
  return plot;
}

void add_rows(const std::string& name, const Measured& m, std::vector<report::ReproduceRow>& rows) {
  const auto add = [&](std::size_t i, const char* what, double steps) {
    rows.push_back(row_without_aim("the model has a free unit", "fig7",
                                   fmt::format("{}, regions {}: {}", name, m.regions[i], what), "1",
                                   {}, steps));
  };
  const double by_area_unit = fitted_unit(m, by_area_smooth);
  const double by_factor_unit = fitted_unit(m, by_factor_smooth);
  for (std::size_t i = 0; i < m.xi.size(); ++i) {
    add(i, "steps of DCA, n = 1024", m.steps[i]);
    add(i, "predicted by Eq 10", by_factor_unit * by_factor_smooth(m.xi[i]));
    add(i, "predicted by Eq 13", by_area_unit * by_area_smooth(m.xi[i]));
  }
}

}  // namespace

void gather_fig7(const ReproduceOptions& options, const Stop& stop,
                 std::vector<report::ReproduceRow>& rows) {
  const int trials = options.quick ? 2 : 12;
  std::vector<report::Plot> plots{plot_of_models()};
  for (const auto& [name, scene] :
       {std::pair<std::string, scenes::Vascular>{"Fig 8(b)", scenes::vascular_network()},
        {"Fig 8(c)", scenes::larger_vascular_network()}}) {
    if (stop()) return;
    const Measured m = measured(scene, trials, stop);
    add_rows(name, m, rows);
    plots.push_back(draw_plot(name, m));
  }
  if (!options.out.empty() && !stop())
    report::write_plots_everywhere(plots, std::filesystem::path(options.out) / "fig7");
}

}  // namespace microswarm::reproduce
