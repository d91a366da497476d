// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <variant>
#include <vector>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/planning/global_input/coverage.hpp"
#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/global/global.hpp"
#include "microswarm/scenes/global_worlds.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;
using scenes::global_goals;
using scenes::global_starts;

constexpr int max_nodes = 7500;
constexpr std::array tree_sizes{1000, 2500, 5000, max_nodes};
constexpr double grid_cell =
    50;  // [µm]: "coverage decreases as grid size decreases", so it is an edge length
constexpr double best_step = 60;      // [µm], the paper's
constexpr double published_step = 5;  // [µm], of Fig 9 and of the published program
constexpr const char* only_drawn = "the paper's value is only in a picture";

int tree_trials(const ReproduceOptions& options) { return options.quick ? 3 : 10; }

/// A tree of two robots without a goal, as in Fig 3–7.
planning::GlobalTree grown(const Map& map, std::span<const Vec2> starts, double step, int nodes,
                           int trial, const Stop& stop) {
  planning::GlobalRrtParams params;
  params.robostep = step;
  params.max_nodes = nodes;
  Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(trial));
  return planning::global_rrt(map, starts, {}, params, rng, stop).tree;
}

/// The first `nodes` nodes of the tree.
planning::GlobalTree first_nodes(planning::GlobalTree tree, std::size_t nodes) {
  if (nodes >= tree.size()) return tree;
  tree.configurations.resize(2 * tree.robots * nodes);
  tree.parents.resize(nodes);
  tree.inputs.resize(nodes);
  return tree;
}

/// Fractions [%] of the configuration space covered by trees, with several trials per x.
struct CoverageCurve {
  CoverageCurve(std::span<const double> xs, int trials)
      : x(xs.begin(), xs.end()), shares(xs.size(), std::vector<double>(std::size_t(trials))) {}
  std::vector<double> x;
  std::vector<std::vector<double>> shares;

  double at(std::size_t k) const { return median(shares[k]); }
  std::size_t best() const {
    std::size_t found = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (at(k) > at(found)) found = k;
    return found;
  }
  report::Series series(std::string label, std::optional<std::size_t> colour = {}) const {
    report::Series s{
        .label = std::move(label), .x = x, .style = report::PlotStyle::marked, .colour = colour};
    for (std::size_t k = 0; k < x.size(); ++k) {
      s.y.push_back(at(k));
      s.low.push_back(quantile(shares[k], 0.25));
      s.high.push_back(quantile(shares[k], 0.75));
    }
    return s;
  }
};

/// Calls measure(index of x, trial) for all combinations, on all cores.
template <class Measure>
void for_each_tree(const CoverageCurve& curve, const Stop& stop, Measure&& measure) {
  const std::size_t trials = curve.shares[0].size();
  for_each_index(curve.x.size() * trials, 0, [&](std::size_t i) {
    if (!stop()) measure(i / trials, i % trials);
  });
}

void write_plot(report::Plot plot, const ReproduceOptions& options, const char* name) {
  plot.y_min = 0;
  plot.key_below = true;
  if (!options.out.empty()) report::write_plots_everywhere({plot}, fs::path(options.out) / name);
}

/// The walls shifted to the right.
std::vector<Body> moved_right(std::span<const Body> walls, double by) {
  std::vector<Body> moved(walls.begin(), walls.end());
  for (Body& body : moved) shift(body, {by, 0});
  return moved;
}

/// Fig 4: trees of two robots for several step lengths, the robots' parts side by side.
void draw_trees(const Map& map, const ReproduceOptions& options, const Stop& stop) {
  if (options.out.empty()) return;
  // The paper uses 0.5 s; the published program creates 3,900 nodes per second here.
  constexpr int nodes = 2000;
  constexpr double gap = 15;
  const Box box = map.bounds();
  const double pitch = box.width() + gap;
  for (const double step : {1., 3., 5., 50., 200.}) {
    const auto starts = std::span(scenes::global_starts).first(2);
    const planning::GlobalTree tree = grown(map, starts, step, nodes, 0, stop);
    report::Picture picture({box.lo, {box.hi.x + pitch, box.hi.y}},
                            fmt::format("Fig 4: {} nodes, Robostep {:g} µm", nodes, step), 1600);
    for (std::size_t robot = 0; robot < 2; ++robot) {
      const Vec2 shift{pitch * static_cast<double>(robot), 0};
      const report::Colour colour = report::colours::robots[robot];
      const report::Colour faint{colour.red, colour.green, colour.blue, 0.55};
      std::vector<TreeNode> part(tree.size());
      for (std::uint32_t node = 0; node < tree.size(); ++node) {
        part[node].position = tree.position(node, robot) + shift;
        part[node].parent = tree.parents[node];
      }
      const Vec2 lo = box.lo + shift;
      const Vec2 hi = box.hi + shift;
      picture.bodies(moved_right(map.walls().bodies(), shift.x), report::colours::wall);
      picture.tree(part, faint);
      picture.line(std::vector<Vec2>{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}, lo},
                   report::colours::wall_edge, 1);
      picture.disc({scenes::global_starts[robot] + shift, 5}, report::colours::ink);
      picture.circle({scenes::global_goals[robot] + shift, 20}, report::colours::ink, 3, false);
      picture.legend(fmt::format("tree of robot {}", robot + 1), colour);
    }
    picture.legend("start; the goal is the circle", report::colours::ink, true);
    picture.write_everywhere(fs::path(options.out) / fmt::format("fig4-step{:g}", step));
  }
}

}  // namespace

// Coverage over Robostep, for trees of several sizes.
std::vector<report::ReproduceRow> global_step_lengths(const ReproduceOptions& options,
                                                      const Stop& stop) {
  constexpr std::array steps{1., 3., 5., 10., 20., 40., 50., 60., 70., 80., 100., 150., 200.};
  constexpr std::size_t at_best = 7;
  static_assert(steps[at_best] == best_step);
  const Map map = scenes::global_world(1);
  const auto starts = std::span(scenes::global_starts).first(2);
  std::vector<CoverageCurve> curves(tree_sizes.size(), CoverageCurve(steps, tree_trials(options)));
  for_each_tree(curves[0], stop, [&](std::size_t k, std::size_t trial) {
    const planning::GlobalTree tree = grown(map, starts, steps[k], max_nodes, int(trial), stop);
    for (std::size_t size = 0; size < tree_sizes.size(); ++size)
      curves[size].shares[k][trial] =
          100 * planning::coverage(map, first_nodes(tree, std::size_t(tree_sizes[size])), grid_cell)
                    .share;
  });
  if (stop()) return {};
  report::Plot plot{.title = "Fig 3, 5: two robots in Env 1; dashed: the paper's best Robostep",
                    .x_label = "Robostep (µm)",
                    .y_label = "coverage (%), median and quartiles",
                    .marks = {{"", best_step}}};
  for (std::size_t k = 0; k < tree_sizes.size(); ++k)
    plot.series.push_back(curves[k].series(fmt::format("{} nodes", tree_sizes[k])));
  write_plot(plot, options, "fig3-5");
  draw_trees(map, options, stop);

  std::vector<report::ReproduceRow> rows;
  for (std::size_t k = 0; k < tree_sizes.size(); ++k)
    rows.push_back(row_without_aim(only_drawn, "fig3",
                                   fmt::format("coverage at step 60, {} nodes", tree_sizes[k]), "%",
                                   {}, curves[k].at(at_best)));
  const CoverageCurve& curve = curves.back();
  rows.push_back(unjudged_if_quick(noted(row_within(1.0 / 6, "fig5", "best step length, 7500 nodes",
                                                    "µm", best_step, curve.x[curve.best()]),
                                         "one step of the curve"),
                                   options));
  rows.push_back(row_without_aim(only_drawn, "fig5", "coverage at step 60, share of the best", "%",
                                 {}, 100 * curve.at(at_best) / curve.at(curve.best())));
  return rows;
}

// Coverage over the edge of the hypercubes.
std::vector<report::ReproduceRow> global_cell_sizes(const ReproduceOptions& options,
                                                    const Stop& stop) {
  constexpr std::array cells{50., 40., 30., 20., 10.};
  const Map map = scenes::global_world(1);
  const auto starts = std::span(scenes::global_starts).first(2);
  CoverageCurve curve(cells, tree_trials(options));
  for_each_index(curve.shares[0].size(), 0, [&](std::size_t trial) {
    const planning::GlobalTree tree = grown(map, starts, best_step, max_nodes, int(trial), stop);
    for (std::size_t k = 0; k < cells.size(); ++k)
      curve.shares[k][trial] = 100 * planning::coverage(map, tree, cells[k]).share;
  });
  if (stop()) return {};
  write_plot({.title = "Fig 6: two robots in Env 1, 7500 nodes, Robostep 60 µm",
              .x_label = "edge of a hypercube (µm)",
              .y_label = "coverage (%), median and quartiles",
              .series = {curve.series("")},
              .x_min = 5,
              .x_max = 55},
             options, "fig6");
  std::vector<report::ReproduceRow> rows;
  for (std::size_t k = 0; k < cells.size(); ++k)
    rows.push_back(row_without_aim(
        "only in a picture; falls with the edge, as the nodes are the same", "fig6",
        fmt::format("coverage, hypercubes of {:g} µm", cells[k]), "%", {}, curve.at(k)));
  return rows;
}

// Coverage over the distance between the two starts: "little effect until a critical distance,
// after which the coverage drops quickly". The paper states neither Robostep nor number of nodes.
std::vector<report::ReproduceRow> global_initial_distances(const ReproduceOptions& options,
                                                           const Stop& stop) {
  constexpr std::array distances{200., 150., 100., 70., 50., 20., 5., 1.};
  constexpr std::size_t at_20 = 5;
  constexpr std::size_t at_1 = distances.size() - 1;
  constexpr double min_plateau = 90;  // [%]
  constexpr double max_left = 60;     // [%]
  std::vector<report::AxisTick> ticks;
  for (const double d : distances)
    if (d != 150) ticks.push_back({fmt::format("{:g}", d), d});  // would touch that of 200
  const Map map = scenes::global_world(1);
  std::vector<report::Plot> plots;
  std::vector<report::ReproduceRow> rows;
  for (const double step : {published_step, best_step}) {
    std::vector<CoverageCurve> curves(tree_sizes.size(),
                                      CoverageCurve(distances, tree_trials(options)));
    for_each_tree(curves[0], stop, [&](std::size_t k, std::size_t trial) {
      const std::array<Vec2, 2> starts{{{60, 300}, {60, 300 - distances[k]}}};
      const planning::GlobalTree tree = grown(map, starts, step, max_nodes, int(trial), stop);
      for (std::size_t size = 0; size < tree_sizes.size(); ++size)
        curves[size].shares[k][trial] =
            100 *
            planning::coverage(map, first_nodes(tree, std::size_t(tree_sizes[size])), grid_cell)
                .share;
    });
    if (stop()) return rows;
    report::Plot& plot = plots.emplace_back(
        report::Plot{.title = fmt::format("Fig 7: Env 1, Robostep {:g} µm", step),
                     .x_label = "distance between the starts (µm)",
                     .y_label = "coverage (%), median and quartiles",
                     .x_ticks = ticks,
                     .log_x = true,
                     .key_below = true,
                     .x_min = 0.8,
                     .x_max = 250,
                     .y_min = 0});
    for (std::size_t size = 0; size < tree_sizes.size(); ++size) {
      const CoverageCurve& curve = curves[size];
      plot.series.push_back(curve.series(fmt::format("{} nodes", tree_sizes[size])));
      if (size != 0 && size != tree_sizes.size() - 1) continue;
      const auto row = [&](const char* at, std::size_t k, double aim, bool at_most) {
        const std::string what =
            fmt::format("Robostep {:g}, {} nodes: coverage at {}, share of that at 200 µm", step,
                        tree_sizes[size], at);
        rows.push_back(unjudged_if_quick(
            noted(make_row("fig7", what, "%", {}, 100 * curve.at(k) / curve.at(0), aim, at_most),
                  at_most ? "aim is ours, for \"drops quickly\""
                          : "aim is ours, for \"little effect\""),
            options));
      };
      row("20 µm", at_20, min_plateau, false);
      row("1 µm", at_1, max_left, true);
    }
  }
  if (!options.out.empty()) report::write_plots_everywhere(plots, fs::path(options.out) / "fig7");
  return rows;
}

}  // namespace microswarm::reproduce
