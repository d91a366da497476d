// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/planning/coverage.hpp"
#include "microswarm/planning/global_rrt.hpp"
#include "microswarm/planning/global_search.hpp"
#include "microswarm/planning/global_shorten.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/plot.hpp"
#include "reproduce_figures.hpp"
#include "reproduce_global.hpp"
#include "tests/scenes/global_worlds.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;
using scenes::global_goals;
using scenes::global_starts;

constexpr double grid_cell =
    50;  // [µm]: "coverage decreases as grid size decreases", so it is an edge

std::span<const Vec2> first(std::span<const Vec2> places, std::size_t count) {
  return places.first(count);
}

void write_all(const std::vector<Plot>& plots, const ReproduceOptions& options, const char* name) {
  if (options.out.empty()) return;
  for (const char* kind : {".png", ".svg", ".pdf"})
    write_plots(plots, fs::path(options.out) / (std::string(name) + kind));
}

/// A tree that knows no goal, as those of Fig 3–7.
GlobalTree grown(const Map& map, std::span<const Vec2> starts, double step, int nodes, int trial,
                 const Stop& stop) {
  GlobalRrtParams params;
  params.robostep = step;
  params.max_nodes = nodes;
  Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(trial));
  return global_rrt(map, starts, {}, params, rng, stop).tree;
}

/// Mean share [%] of the configuration space in Env 1 that trees of two robots have seen.
double mean_coverage(const Map& map, std::span<const Vec2> starts, double step, int nodes,
                     double cell, int trials, const Stop& stop) {
  std::vector<double> shares;
  for (int trial = 0; trial < trials && !stop(); ++trial)
    shares.push_back(100 * coverage(map, grown(map, starts, step, nodes, trial, stop), cell).share);
  return mean(shares);
}

struct CoverageCurve {
  std::vector<double> x, y;
  double best() const {
    return x.empty()
               ? 0
               : x[static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin())];
  }
};

/// Fig 4: trees of two robots by several step lengths, each robot's part in a colour.
void draw_trees(const Map& map, const ReproduceOptions& options, const Stop& stop) {
  if (options.out.empty()) return;
  constexpr int nodes = 7500;
  constexpr std::array<Colour, 2> colour{{{0.35, 0.70, 0.90, 0.8}, {0.90, 0.62, 0.0, 0.8}}};
  for (const double step : {1., 3., 5., 50., 200.}) {
    const GlobalTree tree = grown(map, first(global_starts, 2), step, nodes, 0, stop);
    Picture picture(map.bounds(), fmt::format("Fig 4: {} nodes, Robostep {:g} µm", nodes, step));
    picture.walls(map);
    for (std::size_t robot = 0; robot < 2; ++robot) {
      std::vector<TreeNode> part(tree.size());
      for (std::uint32_t node = 0; node < tree.size(); ++node) {
        part[node].position = tree.position(node, robot);
        part[node].parent = tree.parents[node];
      }
      picture.tree(part, colour[robot]);
      picture.mark(global_starts[robot], fmt::format("start {}", robot + 1));
      picture.legend(fmt::format("tree of robot {}", robot + 1), colour[robot]);
    }
    picture.write(fs::path(options.out) / fmt::format("fig4-step{:g}.png", step));
  }
}

/// Fig 3–5: coverage against Robostep, for trees of several sizes.
std::vector<ReproduceRow> step_lengths(const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array steps{1., 3., 5., 10., 20., 40., 50., 60., 70., 80., 100., 150., 200.};
  constexpr std::array sizes{1000, 2500, 5000, 7500};
  const Map map = scenes::global_world(1);
  const int trials = options.quick ? 3 : 10;
  std::vector<CoverageCurve> curves(sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k)
    for (const double step : steps) {
      curves[k].x.push_back(step);
      curves[k].y.push_back(
          mean_coverage(map, first(global_starts, 2), step, sizes[k], grid_cell, trials, stop));
    }
  Plot plot{.title = "Fig 3, 5: two robots in Env 1, hypercubes of 50 µm",
            .x_label = "Robostep (µm)",
            .y_label = "coverage (%)",
            .y_min = 0};
  for (std::size_t k = 0; k < sizes.size(); ++k)
    plot.series.push_back({fmt::format("{} nodes", sizes[k]), curves[k].x, curves[k].y});
  write_all({plot}, options, "fig3-5");
  draw_trees(map, options, stop);
  std::vector<ReproduceRow> rows;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    rows.push_back(row_of("fig3", fmt::format("coverage at step 60, {} nodes", sizes[k]), "%", {},
                          curves[k].y[7]));
  rows.push_back(row_of("fig3", "coverage, 7500 nodes to 1000, at step 60", "1", {},
                        curves[3].y[7] / std::max(1e-12, curves[0].y[7]), 1, false));
  rows.push_back(row_of("fig5", "best step length, 7500 nodes", "µm", 60, curves[3].best()));
  rows.push_back(row_of(
      "fig5", "coverage at step 60, share of the best", "%", {},
      100 * curves[3].y[7] / std::max(1e-12, *std::ranges::max_element(curves[3].y)), 90, false));
  return rows;
}

/// Fig 6: coverage against the edge of the hypercubes.
std::vector<ReproduceRow> cell_sizes(const ReproduceOptions& options, const Stop& stop) {
  const Map map = scenes::global_world(1);
  const int trials = options.quick ? 3 : 10;
  CoverageCurve curve;
  bool falls = true;
  for (const double cell : {50., 40., 30., 20., 10.}) {
    const double share = mean_coverage(map, first(global_starts, 2), 60, 7500, cell, trials, stop);
    falls = falls && (curve.y.empty() || share < curve.y.back());
    curve.x.push_back(cell);
    curve.y.push_back(share);
  }
  write_all({{.title = "Fig 6: 7500 nodes, step 60",
              .x_label = "edge of a hypercube (µm)",
              .y_label = "coverage (%)",
              .series = {{"", curve.x, curve.y}},
              .y_min = 0}},
            options, "fig6");
  return {row_of("fig6", "coverage, hypercubes of 50 µm", "%", {}, curve.y.front()),
          row_of("fig6", "coverage, hypercubes of 10 µm", "%", {}, curve.y.back()),
          row_of("fig6", "falls with every smaller hypercube (1: yes)", "1", 1, falls ? 1 : 0, 1,
                 false)};
}

/// Fig 7: coverage against the distance between the two starts.
std::vector<ReproduceRow> initial_distances(const ReproduceOptions& options, const Stop& stop) {
  const Map map = scenes::global_world(1);
  const int trials = options.quick ? 3 : 10;
  CoverageCurve curve;
  for (const double distance : {200., 150., 100., 70., 50., 20., 5., 1.}) {
    const std::array<Vec2, 2> starts{{{60, 300}, {60, 300 - distance}}};
    curve.x.push_back(distance);
    curve.y.push_back(mean_coverage(map, starts, 60, 7500, grid_cell, trials, stop));
  }
  write_all({{.title = "Fig 7: 7500 nodes, step 60",
              .x_label = "distance between the starts (µm)",
              .y_label = "coverage (%)",
              .series = {{"", curve.x, curve.y}},
              .y_min = 0}},
            options, "fig7");
  return {row_of("fig7", "coverage, starts 200 µm apart", "%", {}, curve.y.front()),
          row_of("fig7", "coverage, starts 1 µm apart", "%", {}, curve.y.back()),
          row_of("fig7", "coverage at 1 µm, share of that at 200 µm", "%", {},
                 100 * curve.y.back() / std::max(1e-12, curve.y.front()), 100)};
}

struct Aim {
  std::size_t robots;
  double seconds;  // a try may take
  double share;    // of the tries that must be solved [%]
};

/// Beyond the paper: two to four robots in Env 1–4 by the search that uses walls.
std::vector<ReproduceRow> search_rows(const ReproduceOptions& options, const Stop& stop) {
  std::vector<ReproduceRow> rows;
  for (const Aim aim : {Aim{2, 0.5, 100}, Aim{3, 10, 90}, Aim{4, 60, 90}}) {
    const int seeds = options.quick ? (aim.robots < 4 ? 3 : 1) : (aim.robots < 4 ? 20 : 5);
    std::vector<double> times, inputs, brief;
    int solved = 0;
    int tries = 0;
    for (int env = 1; env <= scenes::global_worlds; ++env) {
      const Map map = scenes::global_world(env);
      for (int seed = 0; seed < seeds && !stop(); ++seed) {
        Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
        const auto began = Stop::Clock::now();
        const Stop deadline(std::chrono::duration_cast<Stop::Clock::duration>(
            std::chrono::duration<double>(aim.seconds)));
        const GlobalSearch found =
            global_search(map, first(global_starts, aim.robots), first(global_goals, aim.robots),
                          {}, rng, deadline);
        times.push_back(std::chrono::duration<double>(Stop::Clock::now() - began).count());
        solved += found.plan.status == Status::solved;
        ++tries;
        if (found.plan.status == Status::solved) {
          const auto goals = first(global_goals, aim.robots);
          inputs.push_back(static_cast<double>(found.plan.inputs.size()));
          brief.push_back(
              static_cast<double>(shortened(map, found.plan, goals, {}, stop).inputs.size()));
        }
        if (seed == 0)
          draw_plan(options, fmt::format("env{}-n{}", env, aim.robots),
                    fmt::format("Env {}, {} robots, {} inputs", env, aim.robots,
                                found.plan.inputs.size()),
                    map, found.plan, first(global_goals, aim.robots));
      }
    }
    const std::string who =
        fmt::format("{} robots, Env 1–4, within {:g} s", aim.robots, aim.seconds);
    rows.push_back(row_of("beyond", who + ": solved", "%", {}, 100.0 * solved / std::max(1, tries),
                          aim.share, false));
    rows.push_back(row_of("beyond", who + ": time, median", "s", {}, median(times)));
    rows.push_back(row_of("beyond", who + ": time, longest", "s", {}, quantile(times, 1)));
    rows.push_back(row_of("beyond", who + ": inputs, median", "1", {}, median(inputs)));
    rows.push_back(
        row_of("beyond", who + ": inputs when shortened, median", "1", {}, median(brief)));
  }
  return rows;
}

}  // namespace

std::vector<ReproduceRow> reproduce_global(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array<Figure, 9> figures{{{"fig1", global_vascular},
                                           {"fig3-5", step_lengths},
                                           {"fig6", cell_sizes},
                                           {"fig7", initial_distances},
                                           {"fig8", global_digestive},
                                           {"fig9-10", global_reuse},
                                           {"fig12", global_magnets},
                                           {"beyond", search_rows},
                                           {"beyond-6", global_six}}};
  return reproduce_figures("global", figures, figure, options, stop);
}

}  // namespace microswarm::cli
