// SPDX-License-Identifier: Apache-2.0
// Figures 5, 6 and 10 of [radar]: one obstacle that comes down at the swarm.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/core/parallel.hpp"
#include "radar_picture.hpp"
#include "reproduce_gather.hpp"
#include "reproduce_radar.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

constexpr double begun = 0.01;  // an avoidance cost of so much is no rounding of directions
constexpr double noise = 1;     // [µm] of a place seen

/// One case, and what the paper gives of it. "The avoidance cost becomes larger than 0" when the
/// obstacle enters.
struct Case {
  const char* name;
  double safety_distance;                                // d_f [px]
  double detection_range;                                // d_r [px]
  std::optional<double> entered, left, total, avoiding;  // [s]
  double cost;
};

/// Three cases on one geometry.
struct CaseFigure {
  const char* name;
  const char* scenario;
  double um_per_px;
  double between;  // a moment that is drawn, between entering and leaving [s]
  std::array<Case, 3> cases;
};

constexpr CaseFigure simulated{"fig5-6",
                               "single.yaml",
                               1,
                               28,
                               {{{"Case I", 25, 70, 12.1, 30.6, 48.8, 18.5, 0.14},
                                 {"Case II", 25, 250, 7.9, 37.3, 51.9, 29.4, 0.18},
                                 {"Case III", 205, 250, 7.9, 39.0, 58.6, 31.1, 0.28}}}};
constexpr CaseFigure experiments{"fig10",
                                 "experiment_single.yaml",
                                 radar_um_per_px,
                                 20,
                                 {{{"Case I", 25, 70, 11.1, 32.8, {}, {}, 0.15},
                                   {"Case II", 25, 250, {}, {}, {}, {}, 0.24},
                                   {"Case III", 205, 250, {}, {}, {}, {}, 0.29}}}};

RadarSetting setting_of(const CaseFigure& figure, const Case& c, const ReproduceOptions& options) {
  RadarSetting s = load_radar(options, figure.scenario);
  s.params().safety_distance = c.safety_distance * figure.um_per_px;
  s.params().detection_range = c.detection_range * figure.um_per_px;
  return s;
}

/// From the first to the last moment with the obstacle in the detection circle.
Period detected_period(const Record& record) {
  const std::vector<Period> periods = periods_detected(record);
  return periods.empty() ? Period{} : Period{periods.front().from, periods.back().to};
}

void add_case_rows(const char* figure, const Case& c, const RadarRun& run,
                   std::vector<ReproduceRow>& rows) {
  const Metrics& m = run.record.result.metrics;
  const Period period = detected_period(run.record);
  const auto name = [&](const char* what) { return fmt::format("{}: {}", c.name, what); };
  const auto time = [&](const char* what, std::optional<double> paper, std::optional<double> ours) {
    rows.push_back(row_within(near_time, figure, name(what), "s", paper, ours));
  };
  rows.push_back(row_within(near_cost, figure, name("mean avoidance cost"), "1", c.cost,
                            m.avoidance.mean_cost));
  time("total time", c.total, run.crossed() ? std::optional(m.time) : std::nullopt);
  time("avoidance time", c.avoiding, m.avoidance.time);
  time("obstacle enters the detection circle", c.entered, period.from);
  time("avoidance cost exceeds 0.01", c.entered, cost_above(run.record, begun));
  time("obstacle leaves the detection circle", c.left, period.to);
  rows.push_back(row_of(figure, name("least gap"), "µm", {}, m.avoidance.least_gap));
}

/// The same with places seen a little wrong: how much hangs on a hair.
void add_noise_rows(const char* figure, const Case& c, RadarSetting s, int side,
                    const ReproduceOptions& options, const Stop& stop,
                    std::vector<ReproduceRow>& rows) {
  s.scene.scenario.sensing.position_noise = noise;
  const std::size_t runs = options.quick ? 10 : 20;
  std::vector<double> times(runs);
  std::vector<int> same(runs);
  for_each_index(runs, 0, [&](std::size_t k) {
    if (stop()) return;
    const RadarRun run = run_radar(s.scene, s.world, stop, static_cast<std::uint32_t>(k));
    times[k] = run.record.result.metrics.time;
    same[k] = run.crossed() && side_passed(run.record) == side;
  });
  if (stop()) return;
  const auto add = [&](const char* what, const char* unit, double ours) {
    rows.push_back(
        row_of(figure, fmt::format("{}, places 1 µm uncertain: {}", c.name, what), unit, {}, ours));
    rows.back().note = fmt::format("{} runs", runs);
  };
  const auto share =
      static_cast<double>(std::count(same.begin(), same.end(), 1)) / static_cast<double>(runs);
  add("passed on the same side", "%", 100 * share);
  add("least total time", "s", *std::min_element(times.begin(), times.end()));
  add("greatest total time", "s", *std::max_element(times.begin(), times.end()));
}

void draw(const CaseFigure& figure, const std::vector<RadarRun>& runs,
          const std::vector<RadarSetting>& settings, const ReproduceOptions& options) {
  if (options.out.empty()) return;
  double most = 0;
  for (const RadarRun& run : runs)
    for (const Frame& frame : run.record.frames) most = std::max(most, frame.avoidance_cost);
  std::vector<Plot> plots;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Case& c = figure.cases[k];
    plots.push_back(cost_plot(runs[k], c.name, c.cost, 1.1 * most));
    if (c.entered) plots.back().marks.push_back({"paper: enters", *c.entered});
    if (c.left) plots.back().marks.push_back({"paper: leaves", *c.left});
    const Period period = detected_period(runs[k].record);
    const std::array<double, 5> moments{0, period.from, figure.between, period.to,
                                        runs[k].record.result.metrics.time};
    draw_radar_moments(runs[k], settings[k].world, moments, c.name,
                       fs::path(options.out) / fmt::format("{}-case{}", figure.name, k + 1),
                       part_that_matters(runs[k], settings[k].world, moments));
  }
  write_everywhere(plots, fs::path(options.out) / fmt::format("{}-cost", figure.name));
}

/// The three cases: rows, δ over time, pictures.
std::vector<ReproduceRow> cases(const CaseFigure& figure, bool with_noise,
                                const ReproduceOptions& options, const Stop& stop) {
  std::vector<ReproduceRow> rows, noisy;
  std::vector<RadarRun> runs;
  std::vector<RadarSetting> settings;
  int contacts = 0;
  for (const Case& c : figure.cases) {
    settings.push_back(setting_of(figure, c, options));
    runs.push_back(run_radar(settings.back().scene, settings.back().world, stop));
    if (stop()) return rows;
    add_case_rows(figure.name, c, runs.back(), rows);
    contacts += runs.back().record.result.metrics.contacts + !runs.back().crossed();
    if (with_noise)
      add_noise_rows(figure.name, c, settings.back(), side_passed(runs.back().record), options,
                     stop, noisy);
  }
  if (stop()) return rows;
  rows.push_back(row_of(figure.name, "contacts, or goals not reached", "1", 0, contacts, 0));
  rows.insert(rows.end(), noisy.begin(), noisy.end());
  draw(figure, runs, settings, options);
  return rows;
}

}  // namespace

std::vector<ReproduceRow> radar_single(const ReproduceOptions& options, const Stop& stop) {
  return cases(simulated, true, options, stop);
}

std::vector<ReproduceRow> radar_experiment(const ReproduceOptions& options, const Stop& stop) {
  return cases(experiments, false, options, stop);
}

}  // namespace microswarm::cli
