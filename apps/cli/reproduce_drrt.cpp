// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/experiment/record.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/planning/straighten.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/report/run_report.hpp"
#include "reproduce_figures.hpp"
#ifdef MICROSWARM_HAS_LEARNING
#include "follower_rows.hpp"
#endif

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

double percent_less(double ours, double theirs) {
  return theirs == 0 ? 0 : 100 * (1 - ours / theirs);
}

struct Setting {
  Scene scene;
  World world;
};

Setting load(const ReproduceOptions& options, const char* name) {
  const fs::path file = options.scenarios / "papers" / "drrt" / name;
  Scene scene = load_scene(read_scenario(file), file.parent_path());
  World world = build_world(scene);
  return {std::move(scene), std::move(world)};
}

// Fig 3: one channel, four planners, one clearance, one stopping rule.

struct Outcome {
  std::string name;
  std::vector<double> length;           // [µm]
  std::vector<double> turning;          // [°], without the turn out of the start's heading
  std::vector<double> turning_in_full;  // [°], with it
  std::vector<double> time;             // [ms]
  int solved = 0;
  Plan first;
};

// What D-RRT* does to its path, done to another planner's: so that what comes of the planner and
// what comes of the straightening can be told apart.
void pull_straight(const Snapshot& world, Pose2 start, const PlannerParams& params, Plan& made) {
  const DrrtStarParams drrt;
  const double clearance = std::visit([](const auto& p) { return p.clearance; }, params);
  straighten(world, clearance, start.heading, {drrt.length_weight, drrt.smoothness_weight},
             straighten_rounds, made.path, made.counts.edge_checks);
}

enum class Finish { as_planned, straightened };

Outcome try_planner(const Setting& s, std::string name, const PlannerParams& params, int seeds,
                    const Stop& stop, Finish finish = Finish::as_planned) {
  Outcome out{.name = std::move(name)};
  const Scenario& scenario = s.scene.scenario;
  const Snapshot world = s.world.at(0);
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng(scenario.seed, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = Stop::Clock::now();
    Plan made = plan(world, *scenario.start, *scenario.goal, params, rng, stop);
    if (finish == Finish::straightened) pull_straight(world, *scenario.start, params, made);
    out.time.push_back(
        std::chrono::duration<double, std::milli>(Stop::Clock::now() - began).count());
    if (made.status == Status::solved) {
      ++out.solved;
      out.length.push_back(path_length(made.path));
      out.turning.push_back(degrees(path_turning(made.path)));
      out.turning_in_full.push_back(degrees(path_turning(made.path, scenario.start->heading)));
    }
    if (seed == 0) out.first = std::move(made);
  }
  return out;
}

std::vector<Outcome> try_planners(const Setting& s, int seeds, const Stop& stop) {
  DrrtStarParams plain;
  plain.straighten = false;
  std::vector<Outcome> out;
  out.push_back(try_planner(s, "D-RRT*", DrrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "D-RRT* as printed", plain, seeds, stop));
  out.push_back(try_planner(s, "RRT*", RrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "uniform RRT*", UniformRrtStarParams{}, seeds, stop));
  out.push_back(try_planner(s, "A*", AStarParams{}, seeds, stop));
  out.push_back(
      try_planner(s, "RRT*, straightened", RrtStarParams{}, seeds, stop, Finish::straightened));
  out.push_back(
      try_planner(s, "A*, straightened", AStarParams{}, seeds, stop, Finish::straightened));
  return out;
}

struct Published {
  std::optional<double> length, turning, time;
};

std::vector<ReproduceRow> fig3_rows(const std::vector<Outcome>& o) {
  // RRT*'s medians are published only as shares of D-RRT*'s.
  const std::array<Published, 7> paper{{{1679.8, 170.8, 55.0},
                                        {1679.8, 170.8, 55.0},
                                        {1679.8 / (1 - 0.055), 170.8 / (1 - 0.551), {}},
                                        {},
                                        {1702.3, 585.0, 10.0},
                                        {},
                                        {}}};
  const std::string f = "fig3";
  std::vector<ReproduceRow> rows;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto row = [&](const char* what, const char* unit, std::optional<double> theirs,
                         double ours) {
      rows.push_back({.figure = f,
                      .quantity = o[i].name + ": " + what,
                      .unit = unit,
                      .paper = theirs,
                      .ours = ours});
    };
    row("path length, median", "µm", paper[i].length, median(o[i].length));
    row("turning, median", "°", paper[i].turning, median(o[i].turning));
    row("turning with the start's, median", "°", {}, median(o[i].turning_in_full));
    row("planning time, median", "ms", paper[i].time, median(o[i].time));
    rows.push_back(
        {.figure = f,
         .quantity = o[i].name + ": paths found",
         .unit = "%",
         .ours = 100.0 * o[i].solved / std::max<double>(1, static_cast<double>(o[i].time.size())),
         .aim = 100,
         .at_most = false});
  }
  const Outcome& ours = o[0];
  const Outcome& rrt = o[2];
  const Outcome& a_star = o[4];
  const auto less = [&](const char* what, double v, double theirs, double aim) {
    rows.push_back({.figure = f,
                    .quantity = what,
                    .unit = "%",
                    .paper = theirs,
                    .ours = v,
                    .aim = aim,
                    .at_most = false});
  };
  less("shorter than RRT*", percent_less(median(ours.length), median(rrt.length)), 5.5, 5.5);
  less("less turning than RRT*", percent_less(median(ours.turning), median(rrt.turning)), 55.1, 55);
  less("shorter than A*", percent_less(median(ours.length), median(a_star.length)), 2.6, 0);
  less("less turning than A*", percent_less(median(ours.turning), median(a_star.turning)), 75.4,
       75);
  less("less turning than RRT*, start's included",
       percent_less(median(ours.turning_in_full), median(rrt.turning_in_full)), 55.1, 55);
  // No path can reach this one: the start's heading points away from the goal, and 165° of every
  // path's turning are the way out of it.
  less("less turning than A*, start's included",
       percent_less(median(ours.turning_in_full), median(a_star.turning_in_full)), 75.4, 75);
  rows.push_back({.figure = f,
                  .quantity = "D-RRT*: planning time, p99",
                  .unit = "ms",
                  .ours = quantile(ours.time, 0.99),
                  .aim = 5});
  return rows;
}

void fig3_pictures(const Setting& s, const std::vector<Outcome>& o, const fs::path& folder) {
  const Scenario& scenario = s.scene.scenario;
  const auto draw = [&](const char* title, const std::string& file, auto&& content) {
    Picture picture(s.world.map->bounds(), title);
    picture.walls(*s.world.map);
    content(picture);
    picture.mark(scenario.start->position, "start");
    picture.circle({*scenario.goal, DrrtStarParams{}.goal_tolerance}, colours::goal);
    picture.mark(*scenario.goal, "goal", colours::goal);
    for (const char* kind : {".png", ".svg", ".pdf"}) picture.write(folder / (file + kind));
  };
  draw("D-RRT*: tree, detection circles along the path, path", "fig3a1", [&](Picture& picture) {
    picture.tree(o[1].first.tree);
    std::size_t n = o[1].first.tree.size() - 1;
    for (std::size_t k = 0; n != 0 && k < o[1].first.tree.size();
         n = o[1].first.tree[n].parent, ++k)
      picture.circle(o[1].first.detections[n].circle, colours::circle, 1);
    picture.line(o[1].first.path, {0.0, 0.45, 0.70, 0.45}, 2.5);
    picture.line(o[0].first.path, colours::path, 3.5);
    picture.legend("tree", colours::tree);
    picture.legend("as printed", {0.0, 0.45, 0.70, 0.45});
    picture.legend("pulled straight", colours::path);
  });
  draw("RRT*, uniform RRT* and A* beside D-RRT*", "fig3a2", [&](Picture& picture) {
    const std::array<Colour, 5> colour{
        colours::path, {0, 0.45, 0.7, 0.4}, colours::obstacle, colours::circle, colours::swarm};
    for (std::size_t i : {0UL, 2UL, 3UL, 4UL}) {
      picture.line(o[i].first.path, colour[i], 3);
      picture.legend(o[i].name, colour[i]);
    }
  });
}

void fig3_plots(const std::vector<Outcome>& o, const fs::path& folder) {
  const Plan& tree = o[1].first;
  Series w1{.label = "w1"}, w2{.label = "w2"}, step{.label = "dynamic step"};
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t n = static_cast<std::uint32_t>(tree.tree.size()) - 1;
       n != 0 && nodes.size() < tree.tree.size(); n = tree.tree[n].parent)
    nodes.push_back(n);
  std::reverse(nodes.begin(), nodes.end());
  const double base = DrrtStarParams{}.step;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Detection& d = tree.detections[nodes[i]];
    for (Series* s : {&w1, &w2, &step}) s->x.push_back(static_cast<double>(i + 1));
    w1.y.push_back(d.w1);
    w2.y.push_back(d.w2);
    step.y.push_back(d.rho * base);
  }
  const std::vector<Plot> b{{.title = "Fig 3(b1): factors along the path",
                             .x_label = "node of the path",
                             .y_label = "factor",
                             .series = {w1, w2},
                             .y_min = 0},
                            {.title = "Fig 3(b2): step",
                             .x_label = "node of the path",
                             .y_label = "step (µm)",
                             .series = {step},
                             .levels = {{"base step", base}},
                             .y_min = 0}};
  std::vector<Plot> c{{.title = "Path length", .y_label = "µm"},
                      {.title = "Turning", .y_label = "°"},
                      {.title = "Planning time", .y_label = "ms", .log_y = true}};
  for (std::size_t i = 0; i < o.size(); ++i) {
    const double x = static_cast<double>(i + 1);
    c[0].series.push_back({o[i].name, {x}, o[i].length, PlotStyle::box});
    c[1].series.push_back({o[i].name, {x}, o[i].turning, PlotStyle::box});
    c[2].series.push_back({o[i].name, {x}, o[i].time, PlotStyle::box});
  }
  for (Plot& plot : c)
    for (Series& s : plot.series) s.x.assign(s.y.size(), s.x[0]);
  c[0].levels = {{"D-RRT* in the paper", 1679.8}};
  c[1].levels = {{"D-RRT* in the paper", 170.8}};
  c[2].levels = {{"D-RRT* in the paper", 55.0}};
  for (const char* kind : {".png", ".svg", ".pdf"}) {
    write_plots(b, folder / (std::string("fig3b") + kind));
    write_plots(c, folder / (std::string("fig3c") + kind));
  }
}

std::vector<ReproduceRow> fig3(const ReproduceOptions& options, const Stop& stop) {
  const Setting s = load(options, "s_channel.yaml");
  const std::vector<Outcome> outcomes = try_planners(s, options.seed_count(), stop);
  if (!options.out.empty() && !stop()) {
    fig3_pictures(s, outcomes, options.out);
    fig3_plots(outcomes, options.out);
  }
  return fig3_rows(outcomes);
}

// Fig 5, 6: a deforming channel and moving obstacles, the whole loop.

struct LoopFigure {
  const char* figure;
  const char* scenario;
  double events, mean, sd, max;  // published [1, ms, ms, ms]
};

constexpr LoopFigure deforming{"fig5a", "deforming_channel.yaml", 16, 8, 3, 15};
constexpr LoopFigure moving{"fig5b", "moving_obstacles.yaml", 34, 44, 41, 100};

/// Every trial meets the obstacles at another phase of their motion.
void vary_phases(Scenario& scenario, std::uint32_t trial) {
  Rng rng(scenario.seed, Purpose::scene, trial);
  for (Obstacle& o : scenario.obstacles) {
    const double phase = rng.uniform();
    if (auto* line = std::get_if<HarmonicLine>(&o.motion)) line->phase = phase;
    if (auto* arc = std::get_if<HarmonicArc>(&o.motion)) arc->phase = phase;
  }
}

std::vector<ReproduceRow> loop_rows(const LoopFigure& f, const std::vector<TrialResult>& trials) {
  std::vector<double> planning;
  int ran = 0;
  int reached = 0;
  double events = 0;
  double least = std::numeric_limits<double>::infinity();
  double least_wall = std::numeric_limits<double>::infinity();
  for (const TrialResult& t : trials) {
    if (!t.ran) continue;
    ++ran;
    reached += t.result.status == Status::solved;
    events += t.result.metrics.planning_events;
    least = std::min(least, t.result.metrics.obstacles.clearance);
    least_wall = std::min(least_wall, t.result.metrics.walls.clearance);
    for (const double time : t.result.timing.planning) planning.push_back(1e3 * time);
  }
  const TimeSummary sum = summarise(planning);  // of milliseconds
  const double n = std::max(1, ran);
  return {{.figure = f.figure,
           .quantity = "goal reached",
           .unit = "%",
           .paper = 100,
           .ours = 100 * reached / n,
           .aim = 100,
           .at_most = false},
          {.figure = f.figure,
           .quantity = "least distance, centre to obstacles",
           .unit = "µm",
           .paper = 90,
           .ours = least,
           .aim = 90,
           .at_most = false},
          {.figure = f.figure,
           .quantity = "least distance, centre to border",
           .unit = "µm",
           .ours = least_wall},
          {.figure = f.figure,
           .quantity = "planning events per run, mean",
           .unit = "1",
           .paper = f.events,
           .ours = events / n},
          {.figure = f.figure,
           .quantity = "planning time, mean",
           .unit = "ms",
           .paper = f.mean,
           .ours = sum.mean,
           .aim = 0.5},
          {.figure = f.figure,
           .quantity = "planning time, sd",
           .unit = "ms",
           .paper = f.sd,
           .ours = sum.sd},
          {.figure = f.figure, .quantity = "planning time, p99", .unit = "ms", .ours = sum.p99},
          {.figure = f.figure,
           .quantity = "planning time, max",
           .unit = "ms",
           .paper = f.max,
           .ours = sum.max,
           .aim = 2}};
}

void loop_pictures(const LoopFigure& f, const Setting& s, const fs::path& out, const Stop& stop) {
  Scene scene = s.scene;
  Recorder recorder(scene);
  RunListener* const listeners[] = {&recorder};
  simulate(scene.scenario, s.world, 0, listeners, stop);
  const fs::path folder = out / f.figure;
  make_folder(folder.string());
  write_record(recorder.record(), folder / "run.h5");
  write_run_report(recorder.record(), folder);
}

std::vector<ReproduceRow> loop_figure(const LoopFigure& f, const ReproduceOptions& options,
                                      const Stop& stop) {
  const Setting s = load(options, f.scenario);
  ProgressBar bar(f.figure);
  // One thread: planning times are measured.
  const auto trials = run_trials(
      s.scene.scenario, s.world,
      {.trials = options.seed_count(),
       .jobs = 1,
       .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); },
       .vary = vary_phases},
      stop);
  if (!options.out.empty() && !stop()) loop_pictures(f, s, options.out, stop);
  return loop_rows(f, trials);
}

#ifdef MICROSWARM_HAS_LEARNING
// The learned controller, of which the paper gives no figures.
std::vector<ReproduceRow> follower(const ReproduceOptions& options, const Stop& stop) {
  const ComparisonOptions comparison{.tasks = options.quick ? 60 : 200};
  const auto outcomes = compare_with_progress(comparison, stop);
  if (stop()) return {};
  if (!options.out.empty()) write_follower_figures(outcomes, comparison, options.out);
  return follower_rows(outcomes);
}
#endif

}  // namespace

std::vector<ReproduceRow> reproduce_drrt(const std::string& figure, const ReproduceOptions& options,
                                         const Stop& stop) {
  static constexpr Figure figures[] = {
      {"fig3", fig3},
      {"fig5a",
       [](const ReproduceOptions& o, const Stop& s) { return loop_figure(deforming, o, s); }},
      {"fig5b", [](const ReproduceOptions& o, const Stop& s) { return loop_figure(moving, o, s); }},
#ifdef MICROSWARM_HAS_LEARNING
      {"follower", follower},
#endif
  };
  return reproduce_figures("drrt", figures, figure, options, stop);
}

}  // namespace microswarm::cli
