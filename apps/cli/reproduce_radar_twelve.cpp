// SPDX-License-Identifier: Apache-2.0
// Figures 8, 11, 12 and 13 of [radar]: twelve obstacles, and the micromaze.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/experiment/progress.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/report/plot.hpp"
#include "radar_picture.hpp"
#include "reproduce_gather.hpp"
#include "reproduce_radar.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_draws = 1000;  // of an obstacle's way

/// Twelve obstacles and what the paper gives.
struct Twelve {
  const char* figure;
  const char* scenario;
  double top_speed;  // [µm/s]
  double cost;
  double total;               // [s]
  std::optional<double> gap;  // mean [µm]
};

/// The obstacles of a scenario anew: back and forth on lines anywhere across the swarm's way, each
/// at 30 to 100 % of the top speed, not over the start or the goal.
void scatter(Scenario& scenario, double top_speed, std::uint32_t trial) {
  Rng rng(scenario.seed, Purpose::scene, trial);
  const auto& map = std::get<PolygonsMap>(scenario.map);
  const double length = map.hi.x - map.lo.x, height = map.hi.y - map.lo.y;
  for (Obstacle& obstacle : scenario.obstacles) {
    const double keep_off =
        std::get<DiscShape>(obstacle.shape).radius + 2 * limits_of(scenario.swarm).radius;
    HarmonicLine line;
    for (int draw = 0; draw < most_draws; ++draw) {
      const double x = map.lo.x + length * rng.uniform(0.15, 0.9);
      line.centre = {x, map.lo.y + height * rng.uniform(0.15, 0.85)};
      line.amplitude = height * rng.uniform(0.1, 0.4) * unit_vector(rng.uniform(0, 2 * pi));
      const Segment way{line.centre - line.amplitude, line.centre + line.amplitude};
      if (distance(scenario.start->position, way) > keep_off &&
          distance(*scenario.goal, way) > keep_off)
        break;
    }
    line.period = 2 * pi * norm(line.amplitude) / (top_speed * rng.uniform(0.3, 1));
    line.phase = rng.uniform();
    obstacle.motion = line;
  }
}

std::vector<ReproduceRow> twelve(const Twelve& f, const ReproduceOptions& options,
                                 const Stop& stop) {
  const RadarSetting s = load_radar(options, f.scenario);
  ProgressBar bar(f.figure);
  const auto trials = run_trials(
      s.scene.scenario, s.world,
      {.trials = options.quick ? 20 : 100,
       .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); },
       .vary = [&](Scenario& scenario,
                   std::uint32_t trial) { scatter(scenario, f.top_speed, trial); }},
      stop);
  if (stop()) return {};
  std::vector<double> costs, totals, gaps;
  int reached = 0, contacts = 0;
  for (const TrialResult& t : trials) {
    const Metrics& m = t.result.metrics;
    contacts += m.contacts;
    if (t.result.status != Status::solved) continue;
    ++reached;
    costs.push_back(m.avoidance.mean_cost);
    totals.push_back(m.time);
    if (m.avoidance.time > 0) gaps.push_back(m.avoidance.mean_gap);
  }
  const Record record = record_of(s, stop);
  const Metrics& shown = record.result.metrics;
  if (!options.out.empty() && !stop()) {
    const fs::path folder = options.out;
    std::array<double, 6> moments{};
    for (std::size_t k = 0; k < moments.size(); ++k)
      moments[k] = shown.time * static_cast<double>(k) / (moments.size() - 1);
    draw_radar_moments(record, s.world, moments, "twelve obstacles", folder / f.figure);
    Series cost{.label = "ours"};
    for (const Frame& frame : record.frames) {
      cost.x.push_back(frame.t);
      cost.y.push_back(frame.avoidance_cost);
    }
    write_everywhere(
        {{.title = fmt::format("mean {:.2f}, paper {:.2f}", shown.avoidance.mean_cost, f.cost),
          .x_label = "time (s)",
          .y_label = "avoidance cost",
          .series = {cost},
          .y_min = 0}},
        folder / fmt::format("{}-cost", f.figure));
  }
  const double n = static_cast<double>(trials.size());
  const std::string of = fmt::format(", median of {} scenes", trials.size());
  return {row_of(f.figure, "goal reached without contact", "%", 100, 100 * reached / n, 100, false),
          row_of(f.figure, "contacts", "1", 0, contacts, 0),
          row_of(f.figure, "mean avoidance cost" + of, "1", f.cost, median(costs)),
          row_of(f.figure, "total time" + of, "s", f.total, median(totals)),
          row_of(f.figure, "mean gap while avoiding" + of, "µm", f.gap, median(gaps)),
          row_of(f.figure, "mean avoidance cost, the scene that is drawn", "1", f.cost,
                 shown.avoidance.mean_cost),
          row_of(f.figure, "total time, the scene that is drawn", "s", f.total, shown.time)};
}

}  // namespace

std::vector<ReproduceRow> radar_twelve(const ReproduceOptions& options, const Stop& stop) {
  return twelve({"fig8", "twelve.yaml", 25, 0.13, 138.4, {}}, options, stop);
}

std::vector<ReproduceRow> radar_twelve_experiment(const ReproduceOptions& options,
                                                  const Stop& stop) {
  return twelve({"fig11-12", "experiment_twelve.yaml", 66.8, 0.25, 158.7, 75.31}, options, stop);
}

std::vector<ReproduceRow> radar_micromaze(const ReproduceOptions& options, const Stop& stop) {
  const RadarSetting s = load_radar(options, "micromaze.yaml");
  const auto trials =
      run_trials(s.scene.scenario, s.world,
                 {.trials = options.quick ? 5 : 20, .progress = {}, .vary = {}}, stop);
  const Record record = record_of(s, stop);
  if (stop()) return {};
  if (!options.out.empty()) {
    std::array<double, 7> moments{};
    for (std::size_t k = 0; k < moments.size(); ++k)
      moments[k] = record.result.metrics.time * static_cast<double>(k) / (moments.size() - 1);
    draw_radar_moments(record, s.world, moments, "micromaze", fs::path(options.out) / "fig13");
  }
  std::vector<double> times;
  int contacts = 0;
  for (const TrialResult& t : trials) {
    contacts += t.result.metrics.contacts;
    if (t.result.status == Status::solved) times.push_back(t.result.metrics.time);
  }
  const double n = static_cast<double>(trials.size());
  return {row_of("fig13", "micromaze: goal reached without contact", "%", 100,
                 100 * static_cast<double>(times.size()) / n, 100, false),
          row_of("fig13", "micromaze: contacts", "1", 0, contacts, 0),
          row_of("fig13", "micromaze: total time, median", "s", 408.2, median(times)),
          row_of("fig13", "micromaze: time spent waiting, the run that is drawn", "s", {},
                 record.result.metrics.hold_time)};
}

}  // namespace microswarm::cli
