// SPDX-License-Identifier: Apache-2.0
// Figures 8, 11 and 12 of [radar]: twelve obstacles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <span>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/run/progress.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/reproduce/radar/radar.hpp"
#include "microswarm/reproduce/radar/radar_picture.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr int max_draws = 1000;               // per obstacle path
constexpr double max_relative_turning = 1.2;  // relative turning with the guard
constexpr const char* chosen =
    "one scene, chosen among 1500 random ones as the published version has the paper's values "
    "there";

/// Twelve obstacles with the paper's values.
struct Twelve {
  const char* figure;
  const char* scenario;
  double top_speed;  // [µm/s]
  double cost;
  double total;               // [s]
  std::optional<double> gap;  // mean [µm]
};

Vec2 rounded(Vec2 p) { return {std::round(p.x), std::round(p.y)}; }

/// Redraws the obstacles of a scenario: each moves back and forth on a random line across the
/// swarm's path, at 30 to 100 % of the top speed and clear of start and goal. Values are rounded so
/// that a written scene is unchanged.
void scatter(experiment::Scenario& scenario, double top_speed, std::uint32_t trial) {
  Rng rng(scenario.seed, Purpose::scene, trial);
  const auto& map = std::get<formats::PolygonsMap>(scenario.map);
  const double length = map.hi.x - map.lo.x, height = map.hi.y - map.lo.y;
  for (Obstacle& obstacle : scenario.obstacles) {
    const double keep_off =
        std::get<DiscShape>(obstacle.shape).radius + 2 * swarm_limits(scenario.swarm).radius;
    HarmonicLine line;
    for (int draw = 0; draw < max_draws; ++draw) {
      const double x = map.lo.x + length * rng.uniform(0.15, 0.9);
      line.centre = rounded({x, map.lo.y + height * rng.uniform(0.15, 0.85)});
      const Vec2 direction = unit_vector(rng.uniform(0, 2 * pi));
      line.amplitude = rounded(height * rng.uniform(0.1, 0.4) * direction);
      const Segment sweep{line.centre - line.amplitude, line.centre + line.amplitude};
      if (distance(scenario.start->position, sweep) > keep_off &&
          distance(*scenario.goal, sweep) > keep_off)
        break;
    }
    line.period = std::ceil(2 * pi * norm(line.amplitude) / (top_speed * rng.uniform(0.3, 1)));
    line.phase = std::round(100 * rng.uniform()) / 100;
    obstacle.motion = line;
  }
}

/// Runs a scenario, with new obstacles in each trial.
std::vector<experiment::TrialResult> run_all(const Twelve& f, const RadarSetting& s, int trials,
                                             const std::function<void(int, int)>& progress,
                                             const Stop& stop) {
  return experiment::run_trials(
      s.scene.scenario, s.world,
      {.trials = trials,
       .progress = progress,
       .vary = [&](experiment::Scenario& scenario,
                   std::uint32_t trial) { scatter(scenario, f.top_speed, trial); }},
      stop);
}

/// The start, the maximum cost in each of the longest avoidance periods, and the end.
std::vector<double> twelve_moments(const experiment::Record& record) {
  constexpr std::size_t most = 4;
  std::vector<Period> periods = periods_detected(record);
  std::sort(periods.begin(), periods.end(),
            [](const Period& a, const Period& b) { return a.to - a.from > b.to - b.from; });
  periods.resize(std::min(periods.size(), most));
  std::vector<double> out{0, record.result.metrics.time};
  for (const Period& period : periods) {
    const auto first =
        record.frames.begin() + static_cast<std::ptrdiff_t>(frame_at(record, period.from));
    const auto last =
        record.frames.begin() + static_cast<std::ptrdiff_t>(frame_at(record, period.to));
    out.push_back(
        std::max_element(first, last, [](const experiment::Frame& a, const experiment::Frame& b) {
          return a.avoidance_cost < b.avoidance_cost;
        })->t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void draw(const Twelve& f, const RadarVersion& version, const RadarSetting& setting,
          const RadarRun& run, const fs::path& folder) {
  const std::string title = fmt::format("twelve obstacles, {}", version.name);
  const fs::path stem = folder / fmt::format("{}-{}", f.figure, version.stem);
  draw_radar_moments(run, setting.world, twelve_moments(run.record), title, stem);
  write_radar_run(run, stem);
  double most = 0;
  for (const experiment::Frame& frame : run.record.frames)
    most = std::max(most, frame.avoidance_cost);
  report::write_plots_everywhere({cost_plot(run, title, f.cost, 1.1 * most)},
                                 folder / fmt::format("{}-cost-{}", f.figure, version.stem));
}

/// Totals over all scenes; costs and times only of crossed scenes.
struct Totals {
  std::vector<double> costs, times, gaps;
  std::vector<double> turning;  ///< of all scenes [°]
  int contacts = 0;

  explicit Totals(std::span<const experiment::TrialResult> trials) {
    for (const experiment::TrialResult& t : trials) {
      const experiment::Metrics& m = t.result.metrics;
      contacts += m.contacts;
      turning.push_back(degrees(m.turning));
      if (t.result.status != Status::solved) continue;
      costs.push_back(m.avoidance.mean_cost);
      times.push_back(m.time);
      if (m.avoidance.time > 0) gaps.push_back(m.avoidance.mean_gap);
    }
  }
};

void add_totals(const Twelve& f, const RadarVersion& version, const Totals& totals,
                const ReproduceOptions& options, std::vector<report::ReproduceRow>& rows) {
  const auto all = totals.turning.size();
  const auto share = static_cast<double>(totals.costs.size()) / static_cast<double>(all);
  const auto judged = [&](report::ReproduceRow row) {
    rows.push_back(row.aim ? unjudged_if_quick(std::move(row), options) : std::move(row));
  };
  judged(row_at_least(0, f.figure, fmt::format("goal reached without contact, {}", version.name),
                      "%", 100, 100 * share));
  judged(
      row_at_most(0, f.figure, fmt::format("contacts, {}", version.name), "1", 0, totals.contacts));
  const std::string of =
      fmt::format("median of {} random scenes that were crossed", totals.costs.size());
  const auto add = [&](double within, const char* what, const char* unit,
                       std::optional<double> paper, const std::vector<double>& values) {
    judged(noted(
        noted(version_row(version, within, f.figure, what, unit, paper, median_if_any(values)), of),
        spread_text(values)));
  };
  add(near_cost, "mean avoidance cost, random scenes", "1", f.cost, totals.costs);
  add(near_time, "total time, random scenes", "s", f.total, totals.times);
  add(near_cost, "mean gap while avoiding, random scenes", "µm", f.gap, totals.gaps);
  rows.push_back(noted(noted(version_row(version, 0, f.figure, "turning, random scenes", "°", {},
                                         median_if_any(totals.turning)),
                             fmt::format("median of {}", all)),
                       spread_text(totals.turning)));
}

void add_drawn(const Twelve& f, const RadarVersion& version, const RadarRun& run,
               std::vector<report::ReproduceRow>& rows) {
  const experiment::Metrics& m = run.record.result.metrics;
  const std::string end =
      run.crossed() ? ""
                    : fmt::format("{} at {:.1f} s", to_string(run.record.result.status), m.time);
  const auto add = [&](const char* what, const char* unit, std::optional<double> paper,
                       double ours) {
    rows.push_back(
        noted(row_without_aim(chosen, f.figure,
                              fmt::format("{}, the scene that is drawn, {}", what, version.name),
                              unit, paper, ours),
              end));
  };
  add("contacts", "1", 0, m.contacts);
  add("mean avoidance cost", "1", f.cost, m.avoidance.mean_cost);
  add("total time", "s", f.total, m.time);
  add("mean gap while avoiding", "µm", f.gap, m.avoidance.mean_gap);
  add("turning", "°", {}, degrees(m.turning));
}

/// Ratio of turning with and without the guard; runs continue after a contact.
void add_guard_rows(const Twelve& f, const ReproduceOptions& options, int trials, const Stop& stop,
                    std::vector<report::ReproduceRow>& rows) {
  std::array<double, 2> of_scene{}, of_random{};
  for (const bool guarded : {false, true}) {
    RadarSetting s = load_radar(options, f.scenario, radar_versions.back());
    s.params().safety_filter.active = guarded;
    s.scene.scenario.stop_at_contact = false;
    of_scene[guarded] = run_radar(s.scene, s.world, stop).record.result.metrics.turning;
    of_random[guarded] = median(Totals(run_all(f, s, trials, {}, stop)).turning);
  }
  if (stop()) return;
  const auto add = [&](const char* what, const std::array<double, 2>& turning) {
    rows.push_back(unjudged_if_quick(
        noted(make_row(f.figure, fmt::format("turning with the guard ÷ without, {}", what), "1", {},
                       turning[1] / std::max(turning[0], 1e-9), max_relative_turning),
              "the aim is ours"),
        options));
  };
  add("the scene that is drawn", of_scene);
  add("median of random scenes", of_random);
}

std::vector<report::ReproduceRow> twelve(const Twelve& f, const ReproduceOptions& options,
                                         const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  const int trials = options.quick ? 20 : 100;
  const Progress bar(options.progress, f.figure);
  double before = 0;
  for (const RadarVersion& version : radar_versions) {
    const RadarSetting s = load_radar(options, f.scenario, version);
    const auto progress = [&](int done, int all) {
      bar.update(before + 0.5 * static_cast<double>(done) / all);
    };
    const Totals totals(run_all(f, s, trials, progress, stop));
    const RadarRun run = run_radar(s.scene, s.world, stop);
    if (stop()) return rows;
    before += 0.5;
    add_totals(f, version, totals, options, rows);
    add_drawn(f, version, run, rows);
    if (!options.out.empty()) draw(f, version, s, run, options.out);
  }
  add_guard_rows(f, options, std::min(trials, 40), stop, rows);
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> radar_twelve(const ReproduceOptions& options, const Stop& stop) {
  return twelve({"fig8", "twelve.yaml", 25, 0.13, 138.4, {}}, options, stop);
}

std::vector<report::ReproduceRow> radar_twelve_experiment(const ReproduceOptions& options,
                                                          const Stop& stop) {
  return twelve({"fig11-12", "experiment_twelve.yaml", 66.8, 0.25, 158.7, 75.31}, options, stop);
}

}  // namespace microswarm::reproduce
