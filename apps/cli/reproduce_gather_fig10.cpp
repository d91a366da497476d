// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "cli.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/parallel.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/experiment/progress.hpp"
#include "microswarm/experiment/run.hpp"
#include "microswarm/rig/simulated_rig.hpp"
#include "reproduce_gather.hpp"

namespace microswarm::cli {
namespace {

// Fig 10: a real swarm in frames of the camera, DCA against HRA; here in a simulation of robots
// that are not alike, waver and stick.

constexpr double frames_per_s = 45;
constexpr double um_per_unit = 200;  // the 100 × 90 map is the maze: 20 × 18 mm, channels of 1.8 mm

struct RigMethod {
  const char* name;
  Aggregation aggregation;
  std::optional<double> published;  // [frames]
};
constexpr std::array<RigMethod, 3> rig_methods{{{"HRA", Aggregation::heuristic, 93'063},
                                                {"DCA", Aggregation::divide_and_conquer, 60'628},
                                                {"rollout", Aggregation::rollout, std::nullopt}}};

World maze(const scenes::Vascular& scene) {
  std::vector<Polygon> walls = scene.walls;
  const auto enlarge = [](std::vector<Vec2>& ring) {
    for (Vec2& p : ring) p = um_per_unit * p;
  };
  for (Polygon& wall : walls) {
    enlarge(wall.outer);
    for (auto& hole : wall.holes) enlarge(hole);
  }
  const Box bounds{um_per_unit * scene.bounds.lo, um_per_unit * scene.bounds.hi};
  return {std::make_shared<Map>(bounds, walls), {}};
}

/// 300 robots of 80 µm/s on average. How unlike they are is not published but for the fastest of
/// all, 350 µm/s; with a spread of 0.5 neither method ends.
Scenario rig(const scenes::Vascular& scene, Aggregation method) {
  constexpr double speed = 80;
  Scenario s;
  s.name = "maze";
  s.robots.emplace().count = 300;
  s.robots->max_speed = speed;
  s.robots->speed_spread = 0.15;
  s.robots->heading_noise = radians(5);
  s.robots->position_noise = 5;
  s.robots->sticking_interval = 120;
  s.robots->sticking_time = 5;
  s.sensing.observation_delay = 1 / frames_per_s;
  s.sensing.position_noise = 20;
  s.goal = um_per_unit * scene.goal;
  AggregationParams params = gather_params(scene, method);
  params.scale = um_per_unit;
  params.rollout.most_work = 20e6;
  s.goal_tolerance = params.sigma * um_per_unit;
  s.tick = params.step * um_per_unit / speed;
  s.navigator = params;
  s.time_limit = 10'000;
  s.hold_limit = s.time_limit;
  return s;
}

}  // namespace

void gather_fig10(const ReproduceOptions& options, const Stop& stop,
                  std::vector<ReproduceRow>& rows) {
  const std::size_t trials = options.quick ? 2 : 10;
  const scenes::Vascular scene = scenes::vascular_network();
  const World world = maze(scene);
  std::vector<RunResult> results(rig_methods.size() * trials);
  for_each_index(results.size(), 0, [&](std::size_t i) {
    const Scenario scenario = rig(scene, rig_methods[i / trials].aggregation);
    if (!stop())
      results[i] = simulate(scenario, world, static_cast<std::uint32_t>(i % trials), {}, stop);
  });
  if (stop()) return;
  std::array<double, rig_methods.size()> frames{};
  std::string csv = "method,trial,status,frames\n";
  Plot plot{.title = "300 robots in a maze", .x_label = "trial", .y_label = "frames", .y_min = 0};
  for (std::size_t m = 0; m < rig_methods.size(); ++m) {
    Series series{.label = rig_methods[m].name, .style = PlotStyle::points};
    double gathered = 0;
    for (std::size_t t = 0; t < trials; ++t) {
      const RunResult& result = results[m * trials + t];
      series.x.push_back(static_cast<double>(t + 1));
      series.y.push_back(frames_per_s * result.metrics.time);
      gathered += result.status == Status::solved;
      csv += fmt::format("{},{},{},{:.0f}\n", rig_methods[m].name, t, to_string(result.status),
                         series.y.back());
    }
    frames[m] = mean(series.y);
    rows.push_back(
        {.figure = "fig10",
         .quantity = fmt::format("{}, 300 robots: mean frames at 45 fps", rig_methods[m].name),
         .unit = "1",
         .paper = rig_methods[m].published,
         .ours = frames[m]});
    rows.push_back({.figure = "fig10",
                    .quantity = fmt::format("{}, 300 robots: gathered", rig_methods[m].name),
                    .unit = "%",
                    .ours = 100 * gathered / static_cast<double>(trials),
                    .aim = 100,
                    .at_most = false});
    plot.series.push_back(std::move(series));
  }
  for (const std::size_t m : {1u, 2u})
    rows.push_back({.figure = "fig10",
                    .quantity = fmt::format("{} against HRA", rig_methods[m].name),
                    .unit = "%",
                    .paper = m == 1 ? std::optional(-34.9) : std::nullopt,
                    .ours = 100 * (frames[m] / std::max(1.0, frames[0]) - 1),
                    .aim = m == 1 ? std::optional(-34.9) : std::nullopt});
  if (options.out.empty()) return;
  write_file_atomically(std::filesystem::path(options.out) / "fig10-trials.csv", csv);
  write_everywhere({plot}, std::filesystem::path(options.out) / "fig10");
}

namespace {

/// Robots seen by a camera and driven by coils: how they are commanded.
struct ThroughRig {
  const char* figure;
  const char* what;
  std::optional<double> tick;  // [s] between commands; without: a step of the method
  std::size_t trials;
};

/// The share that is done of runs beside each other, each taken to need 200,000 frames, about what
/// they do; the last twentieth is done when it has ended.
class Shares {
 public:
  Shares(std::string label, std::size_t runs) : bar_(std::move(label)), shares_(runs) {}

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
  ProgressBar bar_;
  std::vector<double> shares_;
};

/// The rollout planner is no method of the paper.
void gather_through_rig(const ThroughRig& how, const ReproduceOptions& options, const Stop& stop,
                        std::vector<ReproduceRow>& rows) {
  const scenes::Vascular scene = scenes::vascular_network();
  const World world = maze(scene);
  const Rig rollers = read_rig(options.scenarios / "rigs/rollers.yaml",
                               {"camera.type=simulated", "camera.microscope.um_per_px=53",
                                "camera.microscope.robot_diameter_px=4", "eye.robots.diameter_px=5",
                                "eye.robots.min_mass=60", "eye.robots.separation_px=3"});
  std::vector<std::optional<RunResult>> results(2 * how.trials);  // of both methods in turn
  {
    Shares shares(how.figure, results.size());
    for_each_index(results.size(), 0, [&](std::size_t i) {
      if (stop()) return;
      Scenario scenario = rig(scene, rig_methods[i % 2].aggregation);
      scenario.tick = how.tick.value_or(scenario.tick);
      ProgressListener progress(
          scenario, [&](const RunProgress& p) { shares.tell_time(i, p.t); }, 10);
      RunListener* const listeners[] = {&progress};
      const RunResult result =
          rehearse(scenario, world, rollers, static_cast<std::uint32_t>(i / 2), listeners, stop);
      if (result.status != Status::stopped) results[i] = result;
      shares.tell(i, 1);
    });
  }
  std::size_t trials = 0;  // that were not stopped
  while (trials < how.trials && results[2 * trials] && results[2 * trials + 1]) ++trials;
  if (trials == 0) return;
  std::array<double, 2> frames{};
  std::string csv = "method,trial,status,frames\n";
  for (std::size_t m = 0; m < frames.size(); ++m) {
    std::vector<double> times;
    double gathered = 0;
    for (std::size_t t = 0; t < trials; ++t) {
      const RunResult& result = *results[2 * t + m];
      times.push_back(frames_per_s * result.metrics.time);
      gathered += result.status == Status::solved;
      csv += fmt::format("{},{},{},{:.0f}\n", rig_methods[m].name, t, to_string(result.status),
                         times.back());
    }
    frames[m] = mean(times);
    const std::string method =
        fmt::format("{} through a rig, {}, {} trials", rig_methods[m].name, how.what, trials);
    rows.push_back(row_of(how.figure, method + ": mean frames at 45 fps", "1",
                          rig_methods[m].published, frames[m]));
    rows.push_back(row_of(how.figure, method + ": gathered", "%", {},
                          100 * gathered / static_cast<double>(trials), 100, false));
  }
  rows.push_back(row_of(how.figure, fmt::format("DCA against HRA, {}", how.what), "%", -34.9,
                        100 * (frames[1] / std::max(1.0, frames[0]) - 1), -34.9));
  if (options.out.empty()) return;
  write_file_atomically(
      std::filesystem::path(options.out) / fmt::format("{}-trials.csv", how.figure), csv);
}

}  // namespace

void gather_fig10_rig(const ReproduceOptions& options, const Stop& stop,
                      std::vector<ReproduceRow>& rows) {
  gather_through_rig({.figure = "fig10-rig",
                      .what = "a command a step",
                      .tick = {},
                      .trials = options.quick ? 2u : 10u},
                     options, stop, rows);
}

void gather_fig10_frames(const ReproduceOptions& options, const Stop& stop,
                         std::vector<ReproduceRow>& rows) {
  gather_through_rig({.figure = "fig10-frames",
                      .what = "a command a frame",
                      .tick = 1 / frames_per_s,
                      .trials = options.quick ? 1u : 3u},
                     options, stop, rows);
}

}  // namespace microswarm::cli
