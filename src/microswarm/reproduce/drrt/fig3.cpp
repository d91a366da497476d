// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/planning/common/detection.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/planning/trees/straighten.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/drrt/drrt.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

// Fig 3: one channel, four planners, with equal clearance and stopping rule.

struct Outcome {
  std::string name;
  std::vector<double> length;           // [µm]
  std::vector<double> excess;           // [%] over the shortest, if led on to the goal itself
  std::vector<double> turning;          // [°], without the initial turn from the start heading
  std::vector<double> turning_in_full;  // [°], with it
  std::vector<double> time;             // [ms]
  int solved = 0;
  Plan first;
};

// Applies D-RRT*'s straightening to the path of another planner, to separate the effects of planner
// and straightening.
void pull_straight(const Snapshot& world, Pose2 start, const planning::PlannerParams& params,
                   Plan& made) {
  const planning::DrrtStarParams drrt;
  const double clearance = std::visit([](const auto& p) { return p.clearance; }, params);
  planning::straighten(world, clearance, start.heading,
                       {drrt.length_weight, drrt.smoothness_weight}, planning::straighten_rounds,
                       made.path, made.counts.edge_checks);
}

enum class Finish { as_planned, straightened };

Outcome try_planner(const DrrtSetting& s, std::string name, const planning::PlannerParams& params,
                    int seeds, const Stop& stop, Finish finish = Finish::as_planned) {
  Outcome out{.name = std::move(name)};
  const experiment::Scenario& scenario = s.scene.scenario;
  const Snapshot world = s.world.at(0);
  const double clearance = std::visit([](const auto& p) { return p.clearance; }, params);
  const double shortest = planning::ShortestPaths(*s.world.map, clearance)
                              .find(scenario.start->position, *scenario.goal, stop)
                              .length;
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng(scenario.seed, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = Stop::Clock::now();
    Plan made = planning::plan(world, *scenario.start, *scenario.goal, params, rng, stop);
    if (finish == Finish::straightened) pull_straight(world, *scenario.start, params, made);
    out.time.push_back(
        std::chrono::duration<double, std::milli>(Stop::Clock::now() - began).count());
    if (made.status == Status::solved) {
      ++out.solved;
      out.length.push_back(path_length(made.path));
      const double left = distance(made.path.back(), *scenario.goal);
      out.excess.push_back(100 * ((path_length(made.path) + left) / shortest - 1));
      out.turning.push_back(degrees(path_turning(made.path)));
      out.turning_in_full.push_back(degrees(path_turning(made.path, scenario.start->heading)));
    }
    if (seed == 0) out.first = std::move(made);
  }
  return out;
}

planning::DrrtStarParams published_planner() {
  planning::DrrtStarParams params;
  params.as_published = true;
  return params;
}

// Index of each outcome.
namespace at {
constexpr std::size_t ours = 0, published = 1, rrt_star = 2, uniform = 3, a_star = 4,
                      rrt_star_straight = 5, a_star_straight = 6, arcs = 7, straight = 8;
}  // namespace at

std::vector<Outcome> try_planners(const DrrtSetting& s, int seeds, const Stop& stop) {
  planning::DrrtStarParams arcs, straight;
  arcs.arcs = true;
  straight.exact_route = false;
  std::vector<Outcome> out;
  out.push_back(try_planner(s, "D-RRT*, ours", planning::DrrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "D-RRT*, as published", published_planner(), seeds, stop));
  out.push_back(try_planner(s, "RRT*", planning::RrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "uniform RRT*", planning::UniformRrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "A*", planning::AStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "RRT*, straightened", planning::RrtStarParams{}, seeds, stop,
                            Finish::straightened));
  out.push_back(try_planner(s, "A*, straightened", planning::AStarParams{}, seeds, stop,
                            Finish::straightened));
  out.push_back(try_planner(s, "D-RRT*, ours with arcs", arcs, seeds, stop));
  out.push_back(try_planner(s, "D-RRT*, straightened", straight, seeds, stop));
  return out;
}

const char* const figure3 = "fig3";

/// Published medians of a planner.
struct Published {
  double length, turning, time;  // [µm, °, ms]
};
constexpr Published published_drrt{1679.8, 170.8, 55};
constexpr double shorter_than_rrt = 5.5, shorter_than_a_star = 2.6;         // [%]
constexpr double less_turning_than_rrt = 55.1, less_turning_than_a = 75.4;  // [%]

double length_median(const Outcome& o) { return median(o.length); }
double turning_median(const Outcome& o) { return median(o.turning); }

/// Rows common to all planners: the shortest path, and whether one was found.
void common_rows(const Outcome& o, std::vector<report::ReproduceRow>& rows) {
  rows.push_back(row_without_aim("", figure3, o.name + ": length over the shortest, median", "%",
                                 {}, median(o.excess)));
  const double n = std::max<double>(1, static_cast<double>(o.time.size()));
  rows.push_back(
      noted(make_row(figure3, o.name + ": paths found", "%", {}, 100.0 * o.solved / n, 100, false),
            "aim is ours"));
}

/// Medians of a planner for which the paper gives no values, or to which we fitted a parameter.
void planner_rows(const Outcome& o, const char* why, std::optional<double> length,
                  std::optional<double> turning, std::optional<double> time,
                  std::vector<report::ReproduceRow>& rows) {
  const auto row = [&](const char* what, const char* unit, std::optional<double> paper,
                       double ours) {
    rows.push_back(
        row_without_aim(paper ? why : "", figure3, o.name + ": " + what, unit, paper, ours));
  };
  row("path length, median", "µm", length, length_median(o));
  row("turning, median", "°", turning, turning_median(o));
  row("turning with the start's, median", "°", {}, median(o.turning_in_full));
  row("planning time, median", "ms", time, median(o.time));
  common_rows(o, rows);
}

/// D-RRT* and the paper's values: the published method has to match them, ours has to be at least
/// as good.
void drrt_rows(const Outcome& o, bool as_published, std::vector<report::ReproduceRow>& rows) {
  const auto row = [&](const char* what, const char* unit, double paper, double ours) {
    const std::string quantity = o.name + ": " + what;
    rows.push_back(as_published ? row_within(0.1, figure3, quantity, unit, paper, ours)
                                : row_at_most(0, figure3, quantity, unit, paper, ours));
  };
  row("path length, median", "µm", published_drrt.length, length_median(o));
  row("turning, median", "°", published_drrt.turning, turning_median(o));
  rows.push_back(row_without_aim("", figure3, o.name + ": turning with the start's, median", "°",
                                 {}, median(o.turning_in_full)));
  rows.push_back(row_without_aim("wall clock of another machine", figure3,
                                 o.name + ": planning time, median", "ms", published_drrt.time,
                                 median(o.time)));
  common_rows(o, rows);
}

std::vector<report::ReproduceRow> fig3_rows(const std::vector<Outcome>& o) {
  std::vector<report::ReproduceRow> rows;
  drrt_rows(o[at::ours], false, rows);
  drrt_rows(o[at::published], true, rows);
  // RRT*'s medians are published only relative to D-RRT*'s.
  planner_rows(o[at::rrt_star], "r_search is fitted to it",
               published_drrt.length / (1 - shorter_than_rrt / 100),
               published_drrt.turning / (1 - less_turning_than_rrt / 100), {}, rows);
  planner_rows(o[at::uniform], "", {}, {}, {}, rows);
  planner_rows(o[at::a_star], "the channel is fitted to its length", 1702.3, 585, 10, rows);
  for (const auto which : {at::rrt_star_straight, at::a_star_straight, at::arcs, at::straight})
    planner_rows(o[which], "", {}, {}, {}, rows);

  const auto less = [&](const Outcome& who, const Outcome& than, const char* what, double paper,
                        double (*measure)(const Outcome&)) {
    const double ours = percent_less(measure(who), measure(than));
    rows.push_back(row_at_least(
        0, figure3, fmt::format("{}: {} than {}", who.name, what, than.name), "%", paper, ours));
  };
  for (const auto who : {at::published, at::ours}) {
    less(o[who], o[at::rrt_star], "shorter", shorter_than_rrt, length_median);
    less(o[who], o[at::rrt_star], "less turning", less_turning_than_rrt, turning_median);
    less(o[who], o[at::a_star], "shorter", shorter_than_a_star, length_median);
    less(o[who], o[at::a_star], "less turning", less_turning_than_a, turning_median);
  }
  // Beside planners that are straightened, too.
  const auto no_worse = [&](std::size_t than, const char* what, double (*measure)(const Outcome&)) {
    rows.push_back(
        noted(make_row(figure3, fmt::format("D-RRT*, ours: {} than {}", what, o[than].name), "%",
                       {}, percent_less(measure(o[at::ours]), measure(o[than])), 0, false),
              "aim is ours"));
  };
  for (const auto than : {at::rrt_star_straight, at::a_star_straight}) {
    no_worse(than, "shorter", length_median);
    no_worse(than, "less turning", turning_median);
  }
  rows.push_back(noted(make_row(figure3, "D-RRT*, ours: planning time, p99", "ms", {},
                                quantile(o[at::ours].time, 0.99), 5),
                       "aim is ours"));
  return rows;
}

void fig3_pictures(const DrrtSetting& s, const std::vector<Outcome>& o, const fs::path& folder) {
  const experiment::Scenario& scenario = s.scene.scenario;
  const auto draw = [&](const char* title, const std::string& file, auto&& content) {
    report::Picture picture(s.world.map->bounds(), title);
    picture.walls(*s.world.map);
    content(picture);
    picture.mark(scenario.start->position, "start");
    picture.circle({*scenario.goal, planning::DrrtStarParams{}.goal_tolerance},
                   report::colours::goal);
    picture.mark(*scenario.goal, "goal", report::colours::goal);
    picture.write_everywhere(folder / file);
  };
  constexpr report::Colour published_path{0.0, 0.45, 0.70, 0.45};
  draw("D-RRT*: tree, detection circles along the path, paths", "fig3a1",
       [&](report::Picture& picture) {
         const Plan& tree = o[at::published].first;
         picture.tree(tree.tree);
         std::size_t n = tree.tree.size() - 1;
         for (std::size_t k = 0; n != 0 && k < tree.tree.size(); n = tree.tree[n].parent, ++k)
           picture.circle(tree.detections[n].circle, report::colours::circle, 1);
         picture.line(tree.path, published_path, 2.5);
         picture.line(o[at::ours].first.path, report::colours::path, 3.5);
         picture.line(o[at::arcs].first.path, report::colours::swarm, 2);
         picture.legend("tree", report::colours::tree);
         picture.legend("detection circle", report::colours::circle);
         picture.legend("as published", published_path);
         picture.legend("ours", report::colours::path);
         picture.legend("ours with arcs", report::colours::swarm);
       });
  draw("RRT*, uniform RRT* and A* beside D-RRT*", "fig3a2", [&](report::Picture& picture) {
    const std::array<std::pair<std::size_t, report::Colour>, 5> lines{
        {{at::ours, report::colours::path},
         {at::published, published_path},
         {at::rrt_star, report::colours::obstacle},
         {at::uniform, report::colours::circle},
         {at::a_star, report::colours::swarm}}};
    for (const auto& [which, colour] : lines) {
      picture.line(o[which].first.path, colour, 3);
      picture.legend(o[which].name, colour);
    }
  });
}

void fig3_plots(const std::vector<Outcome>& o, const fs::path& folder) {
  const Plan& tree = o[at::published].first;
  report::Series w1{.label = "w1"}, w2{.label = "w2"}, step{.label = "dynamic step"};
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t n = static_cast<std::uint32_t>(tree.tree.size()) - 1;
       n != 0 && nodes.size() < tree.tree.size(); n = tree.tree[n].parent)
    nodes.push_back(n);
  std::reverse(nodes.begin(), nodes.end());
  const double base = planning::DrrtStarParams{}.step;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Detection& d = tree.detections[nodes[i]];
    for (report::Series* s : {&w1, &w2, &step}) s->x.push_back(static_cast<double>(i + 1));
    w1.y.push_back(d.w1);
    w2.y.push_back(d.w2);
    step.y.push_back(d.rho * base);
  }
  const std::vector<report::Plot> b{{.title = "Fig 3(b1): factors along the path",
                                     .x_label = "node of the path",
                                     .y_label = "factor",
                                     .series = {w1, w2},
                                     .y_min = 0},
                                    {.title = "Fig 3(b2): step",
                                     .x_label = "node of the path",
                                     .y_label = "step (µm)",
                                     .series = {step},
                                     .levels = {{"base step", base}},
                                     .y_min = 0,
                                     .y_max = 1.15 * base}};
  // The four methods of the paper, with its values as diamonds in the method's colour.
  struct Shown {
    std::size_t which;
    const char* label;
    std::size_t colour;
    std::optional<double> length, turning, time;
  };
  namespace colour = report::method_colours;
  const std::array<Shown, 5> shown{
      {{at::ours, "D-RRT*, ours", colour::drrt_star, {}, {}, {}},
       {at::published, "as published", colour::drrt_star, published_drrt.length,
        published_drrt.turning, published_drrt.time},
       {at::rrt_star,
        "RRT*",
        colour::rrt_star,
        published_drrt.length / (1 - shorter_than_rrt / 100),
        published_drrt.turning / (1 - less_turning_than_rrt / 100),
        {}},
       {at::uniform, "uniform", colour::uniform_rrt_star, {}, {}, {}},
       {at::a_star, "A*", colour::a_star, 1702.3, 585, 10}}};
  std::vector<report::Plot> c{
      {.title = "Path length", .y_label = "path length (µm)"},
      {.title = "Turning", .y_label = "total turning (°)", .y_min = 0},
      {.title = "Planning time", .y_label = "planning time (ms)", .log_y = true}};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Shown& s = shown[i];
    const double x = static_cast<double>(i + 1);
    const auto add = [&](report::Plot& plot, const std::vector<double>& y,
                         std::optional<double> paper) {
      plot.series.push_back(
          {s.label, std::vector<double>(y.size(), x), y, report::PlotStyle::box, s.colour});
      if (paper) plot.series.push_back({"", {x}, {*paper}, report::PlotStyle::published, s.colour});
      plot.x_ticks.push_back({s.label, x});
    };
    add(c[0], o[s.which].length, s.length);
    add(c[1], o[s.which].turning, s.turning);
    add(c[2], o[s.which].time, s.time);
  }
  report::write_plots_everywhere(b, folder / "fig3b");
  report::write_plots_everywhere(c, folder / "fig3c");
}

}  // namespace

double drrt_global_planning_time(const ReproduceOptions& options, const Stop& stop) {
  const DrrtSetting s = load_drrt(options, "s_channel.yaml");
  return median(try_planner(s, "", published_planner(), 20, stop).time);
}

std::vector<report::ReproduceRow> drrt_fig3(const ReproduceOptions& options, const Stop& stop) {
  const DrrtSetting s = load_drrt(options, "s_channel.yaml");
  const std::vector<Outcome> outcomes = try_planners(s, options.seed_count(), stop);
  if (stop()) return {};
  if (!options.out.empty()) {
    fig3_pictures(s, outcomes, options.out);
    fig3_plots(outcomes, options.out);
  }
  return fig3_rows(outcomes);
}

}  // namespace microswarm::reproduce
