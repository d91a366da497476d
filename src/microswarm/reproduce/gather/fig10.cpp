// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/run/progress.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/reproduce/gather/gather.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm::reproduce {
namespace {

// Fig 10: a real swarm in camera frames, DCA against HRA. Here it is a simulation of robots with
// individual speeds, random motion and sticking: scenarios/papers/gather/maze.yaml.

constexpr double frames_per_s = 45;
struct RigMethod {
  const char* name;
  navigation::Aggregation aggregation;
  std::optional<double> published;  // [frames]
  std::size_t colour;
};
constexpr std::array<RigMethod, 3> rig_methods{
    {{"HRA", navigation::Aggregation::heuristic, 93'063, report::method_colours::heuristic},
     {"DCA", navigation::Aggregation::divide_and_conquer, 60'628,
      report::method_colours::divide_and_conquer},
     {"rollout", navigation::Aggregation::rollout, std::nullopt, report::method_colours::rollout}}};

/// Number of robots in an experiment. The paper counts 600 to 1,485 pixels of robots and "over 300"
/// robots; we assume two pixels per robot.
constexpr double pixels_a_robot = 2;
constexpr double mean_pixels = 0.5 * (600 + 1485);  // of the paper's experiments
constexpr std::array<int, 5> populations_of_fig10{300, 410, 520, 630, 740};
int population_of_fig10(std::size_t trial) {
  return populations_of_fig10[trial % populations_of_fig10.size()];
}

experiment::Scene maze(const ReproduceOptions& options, navigation::Aggregation method,
                       int robots) {
  const auto file = options.scenarios / "papers/gather/maze.yaml";
  experiment::Scenario scenario = experiment::read_scenario(file);
  scenario.robots->count = robots;
  std::get<navigation::AggregationParams>(scenario.navigator).method = method;
  return experiment::load_scene(std::move(scenario), file.parent_path());
}

report::ReproduceRow frames_row(const char* figure, const std::string& what,
                                std::optional<double> paper, double ours) {
  return row_without_aim("the speed of led robots and the spread of speeds are not in the paper",
                         figure, what + ": mean frames at 45 fps", "1", paper, ours);
}

report::ReproduceRow gathered_row(const char* figure, const std::string& what, double share) {
  return noted(make_row(figure, what + ": gathered", "%", {}, 100 * share, 100, false),
               "aim is ours");
}

report::ReproduceRow reduction_row(const char* figure, const std::string& what, double dca,
                                   double hra, const ReproduceOptions& options) {
  return unjudged_if_quick(
      row_at_most(0, figure, what, "%", -34.9, 100 * (dca / std::max(1.0, hra) - 1)), options);
}

/// A trial as in fig10-trials.csv and fig10-rig-trials.csv.
struct Fig10Row {
  std::string method;
  int robots = 0;
  std::uint64_t trial = 0;
  Status status = Status::stopped;
  std::uint64_t frames = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.method, plain("method", "Method."));
    visit(self.robots, plain("robots", "Number of robots."));
    visit(self.trial, plain("trial", "Number of the trial."));
    visit(self.status, plain("status", "How it ended."));
    visit(self.frames, plain("frames", "Frames at 45 a second."));
  }
};

std::uint64_t whole(double frames) { return static_cast<std::uint64_t>(std::llround(frames)); }

}  // namespace

void gather_fig10(const ReproduceOptions& options, const Stop& stop,
                  std::vector<report::ReproduceRow>& rows) {
  const std::size_t trials = options.quick ? 2 : 10;
  const std::size_t methods = options.quick ? 2 : rig_methods.size();
  const World world = experiment::build_world(maze(options, navigation::Aggregation::heuristic, 1));
  std::vector<experiment::RunResult> results(methods * trials);
  for_each_index(results.size(), 0, [&](std::size_t i) {
    const std::size_t trial = i % trials;
    const experiment::Scene scene =
        maze(options, rig_methods[i / trials].aggregation, population_of_fig10(trial));
    if (!stop())
      results[i] = experiment::simulate(scene.scenario, world,
                                        {.trial = static_cast<std::uint32_t>(trial)}, {}, stop);
  });
  if (stop()) return;
  std::vector<double> frames;
  std::vector<Fig10Row> table;
  report::Plot plot{.title = "",
                    .x_label = "pixels of robots, two a robot",
                    .y_label = "frames at 45 a second",
                    .y_min = 0};
  plot.key_below = true;
  plot.x_min = 500;
  plot.x_max = 1600;
  for (std::size_t m = 0; m < methods; ++m) {
    report::Series series{.label = rig_methods[m].name,
                          .style = report::PlotStyle::points,
                          .colour = rig_methods[m].colour};
    double gathered = 0;
    for (std::size_t t = 0; t < trials; ++t) {
      const experiment::RunResult& result = results[m * trials + t];
      series.x.push_back(pixels_a_robot * population_of_fig10(t));
      series.y.push_back(frames_per_s * result.metrics.time);
      gathered += result.status == Status::solved;
      table.push_back({.method = rig_methods[m].name,
                       .robots = population_of_fig10(t),
                       .trial = t,
                       .status = result.status,
                       .frames = whole(series.y.back())});
    }
    frames.push_back(mean(series.y));
    const std::string what =
        fmt::format("{}, 300 to 740 robots, {} runs", rig_methods[m].name, trials);
    rows.push_back(frames_row("fig10", what, rig_methods[m].published, frames[m]));
    rows.push_back(row_without_aim("five points in the paper's picture", "fig10",
                                   what + ": standard deviation", "1", {},
                                   standard_deviation(series.y)));
    rows.push_back(gathered_row("fig10", what, gathered / static_cast<double>(trials)));
    if (const auto paper = rig_methods[m].published)
      plot.series.push_back({.label = fmt::format("{}, mean of the paper", rig_methods[m].name),
                             .x = {mean_pixels},
                             .y = {*paper},
                             .style = report::PlotStyle::published,
                             .colour = rig_methods[m].colour});
    plot.series.push_back(std::move(series));
  }
  rows.push_back(reduction_row("fig10", "DCA against HRA", frames[1], frames[0], options));
  if (methods > 2)
    rows.push_back(row_without_aim("not in the paper", "fig10", "rollout against HRA", "%", {},
                                   100 * (frames[2] / std::max(1.0, frames[0]) - 1)));
  if (options.out.empty()) return;
  write_file_atomically(std::filesystem::path(options.out) / "fig10-trials.csv",
                        io::csv_table(table));
  report::write_plots_everywhere({plot}, std::filesystem::path(options.out) / "fig10");
}

namespace {

/// A variant of robots observed by a camera and driven by coils.
struct ThroughRig {
  const char* figure;
  const char* what;
  std::optional<double> tick;  // [s] between commands; empty: one step of the method
  std::size_t trials;
};

/// Completed fraction of parallel runs. Each is expected to need 200,000 frames, a typical number;
/// the last twentieth is completed when the run ends.
class Shares {
 public:
  Shares(const BeginProgress& begin, const std::string& label, std::size_t runs)
      : bar_(begin, label), shares_(runs) {}

  void tell(std::size_t run, double share) {
    const std::scoped_lock lock(mutex_);
    shares_[run] = share;
    bar_.update(mean(shares_));
  }
  void tell_time(std::size_t run, double t) {
    constexpr double usual = 200'000 / frames_per_s;  // [s]
    tell(run, std::min(0.95, t / usual));
  }

 private:
  std::mutex mutex_;
  Progress bar_;
  std::vector<double> shares_;
};

/// The rollout planner is not a method of the paper, so it is omitted.
void gather_through_rig(const ThroughRig& how, const ReproduceOptions& options, const Stop& stop,
                        std::vector<report::ReproduceRow>& rows) {
  const World world = experiment::build_world(maze(options, navigation::Aggregation::heuristic, 1));
  const rig::Rig rollers =
      rig::read_rig(options.scenarios / "rigs/rollers.yaml",
                    {"camera.type=simulated", "camera.microscope.um_per_px=53",
                     "camera.microscope.robot_diameter_px=4", "perception.robots.diameter_px=5",
                     "perception.robots.min_mass=60", "perception.robots.separation_px=3"});
  std::vector<std::optional<experiment::RunResult>> results(
      2 * how.trials);  // of both methods alternately
  {
    Shares shares(options.progress, how.figure, results.size());
    for_each_index(results.size(), 0, [&](std::size_t i) {
      if (stop()) return;
      experiment::Scenario scenario =
          maze(options, rig_methods[i % 2].aggregation, populations_of_fig10[0]).scenario;
      scenario.tick = how.tick.value_or(scenario.tick);
      experiment::ProgressListener progress(
          scenario, [&](const experiment::RunProgress& p) { shares.tell_time(i, p.t); }, 10);
      experiment::RunListener* const listeners[] = {&progress};
      const auto trial = static_cast<std::uint32_t>(i / 2);
      auto rig = std::make_shared<rig::SimulatedRig>(scenario, world, rollers, trial);
      const experiment::RunResult result = experiment::simulate(
          scenario, world, {.trial = trial, .plant = std::move(rig)}, listeners, stop);
      if (result.status != Status::stopped) results[i] = result;
      shares.tell(i, 1);
    });
  }
  std::size_t trials = 0;  // not interrupted
  while (trials < how.trials && results[2 * trials] && results[2 * trials + 1]) ++trials;
  if (trials == 0) return;
  std::array<double, 2> frames{};
  std::vector<Fig10Row> table;
  for (std::size_t m = 0; m < frames.size(); ++m) {
    std::vector<double> times;
    double gathered = 0;
    for (std::size_t t = 0; t < trials; ++t) {
      const experiment::RunResult& result = *results[2 * t + m];
      times.push_back(frames_per_s * result.metrics.time);
      gathered += result.status == Status::solved;
      table.push_back({.method = rig_methods[m].name,
                       .robots = populations_of_fig10[0],
                       .trial = t,
                       .status = result.status,
                       .frames = whole(times.back())});
    }
    frames[m] = mean(times);
    const std::string method =
        fmt::format("{} through a rig, {}, {} trials", rig_methods[m].name, how.what, trials);
    rows.push_back(frames_row(how.figure, method, rig_methods[m].published, frames[m]));
    rows.push_back(gathered_row(how.figure, method, gathered / static_cast<double>(trials)));
  }
  rows.push_back(reduction_row(how.figure, fmt::format("DCA against HRA, {}", how.what), frames[1],
                               frames[0], options));
  if (options.out.empty()) return;
  write_file_atomically(
      std::filesystem::path(options.out) / fmt::format("{}-trials.csv", how.figure),
      io::csv_table(table));
}

}  // namespace

void gather_fig10_rig(const ReproduceOptions& options, const Stop& stop,
                      std::vector<report::ReproduceRow>& rows) {
  gather_through_rig({.figure = "fig10-rig",
                      .what = "a command a step",
                      .tick = {},
                      .trials = options.quick ? 2u : 10u},
                     options, stop, rows);
}

void gather_fig10_frames(const ReproduceOptions& options, const Stop& stop,
                         std::vector<report::ReproduceRow>& rows) {
  gather_through_rig({.figure = "fig10-frames",
                      .what = "a command a frame",
                      .tick = 1 / frames_per_s,
                      .trials = options.quick ? 1u : 3u},
                     options, stop, rows);
}

}  // namespace microswarm::reproduce
