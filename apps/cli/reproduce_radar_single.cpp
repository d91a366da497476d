// SPDX-License-Identifier: Apache-2.0
// Figures 5, 6, 7 and 10 of [radar]: one obstacle that comes down at the swarm.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "microswarm/report/plot.hpp"
#include "radar_picture.hpp"
#include "reproduce_gather.hpp"
#include "reproduce_radar.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

/// When the obstacle enters and leaves the detection circle [s].
std::pair<double, double> entered_and_left(const Record& record) {
  const double range = detection_range_of(record.scene.scenario.navigator);
  double entered = 0, left = 0;
  for (const Frame& f : record.frames) {
    if (f.obstacle_clearance - f.radius >= range) continue;
    if (left == 0) entered = f.t;
    left = f.t + record.scene.scenario.tick;
  }
  return {entered, left};
}

/// One case, and what the paper gives of it.
struct Case {
  const char* name;
  double safety_distance;                                // d_f [px]
  double detection_range;                                // d_r [px]
  std::optional<double> entered, left, total, avoiding;  // [s]
  double cost;
};

constexpr std::array<Case, 3> simulated{{{"Case I", 25, 70, 12.1, 30.6, 48.8, 18.5, 0.14},
                                         {"Case II", 25, 250, 7.9, 37.3, 51.9, 29.4, 0.18},
                                         {"Case III", 205, 250, 7.9, 39.0, 58.6, 31.1, 0.28}}};
constexpr std::array<Case, 3> experiments{{{"Case I", 25, 70, 11.1, 32.8, {}, {}, 0.15},
                                           {"Case II", 25, 250, {}, {}, {}, {}, 0.24},
                                           {"Case III", 205, 250, {}, {}, {}, {}, 0.29}}};

Series cost_over_time(const Record& record, const char* label) {
  Series series{.label = label};
  for (const Frame& f : record.frames) {
    series.x.push_back(f.t);
    series.y.push_back(f.avoidance_cost);
  }
  return series;
}

/// What was fitted or comes near by choice has an aim: within 15 % of the paper, of costs 0.02.
void add_case_rows(const char* figure, const Case& c, const Record& record,
                   std::vector<ReproduceRow>& rows) {
  const Metrics& m = record.result.metrics;
  const auto [entered, left] = entered_and_left(record);
  const auto add = [&](const char* what, const char* unit, std::optional<double> paper,
                       double ours) {
    rows.push_back(row_of(figure, fmt::format("{}: {}", c.name, what), unit, paper, ours));
  };
  add("mean avoidance cost", "1", c.cost, m.avoidance.mean_cost);
  add("total time", "s", c.total, m.time);
  add("avoidance time", "s", c.avoiding, m.avoidance.time);
  add("obstacle enters the detection circle", "s", c.entered, entered);
  add("obstacle leaves it", "s", c.left, left);
  add("least gap", "µm", {}, m.avoidance.least_gap);
}

double off_by(double ours, double paper) { return 100 * std::abs(ours - paper) / paper; }

/// The three cases on one geometry: rows, δ over time, pictures.
std::vector<ReproduceRow> cases(const char* figure, const char* scenario,
                                const std::array<Case, 3>& all, double um_per_px,
                                const ReproduceOptions& options, const Stop& stop) {
  std::vector<ReproduceRow> rows;
  std::vector<Plot> plots;
  double worst_cost = 0, worst_total = 0;
  int contacts = 0;
  for (const Case& c : all) {
    RadarSetting s = load_radar(options, scenario);
    s.params().safety_distance = c.safety_distance * um_per_px;
    s.params().detection_range = c.detection_range * um_per_px;
    const Record record = record_of(s, stop);
    if (stop()) return rows;
    add_case_rows(figure, c, record, rows);
    const Metrics& m = record.result.metrics;
    worst_cost = std::max(worst_cost, off_by(m.avoidance.mean_cost, c.cost));
    if (c.total) worst_total = std::max(worst_total, off_by(m.time, *c.total));
    contacts += m.contacts + (record.result.status != Status::solved);
    plots.push_back({.title = fmt::format("{}: mean {:.2f}, paper {:.2f}", c.name,
                                          m.avoidance.mean_cost, c.cost),
                     .x_label = "time (s)",
                     .y_label = "avoidance cost",
                     .series = {cost_over_time(record, "ours")},
                     .y_min = 0});
    if (options.out.empty()) continue;
    const auto [entered, left] = entered_and_left(record);
    const std::array<double, 4> moments{0, entered, 28, left};
    draw_radar_moments(record, s.world, moments, c.name,
                       fs::path(options.out) / fmt::format("{}-case{}", figure, plots.size()));
  }
  if (!options.out.empty())
    write_everywhere(plots, fs::path(options.out) / fmt::format("{}-cost", figure));
  rows.push_back(row_of(figure, "mean avoidance cost, farthest off the paper's of the three", "%",
                        {}, worst_cost, 15));
  if (worst_total > 0)
    rows.push_back(row_of(figure, "total time, farthest off the paper's of the three", "%", {},
                          worst_total, 5));
  rows.push_back(row_of(figure, "contacts, or goals not reached", "1", 0, contacts, 0));
  return rows;
}

/// A series of Fig 7: radii of one circle, the other one's fixed [px].
struct Sweep {
  const char* name;
  double first, last;
  std::optional<double> safety, detection;
};

constexpr std::array<Sweep, 3> series{{{"series I: r_d, r_f = 150", 170, 350, 150, {}},
                                       {"series II: r_f, r_d = 350", 150, 330, {}, 350},
                                       {"series III: r_f, r_d = 250", 150, 230, {}, 250}}};

}  // namespace

std::vector<ReproduceRow> radar_single(const ReproduceOptions& options, const Stop& stop) {
  return cases("fig5-6", "single.yaml", simulated, 1, options, stop);
}

std::vector<ReproduceRow> radar_experiment(const ReproduceOptions& options, const Stop& stop) {
  return cases("fig10", "experiment_single.yaml", experiments, radar_um_per_px, options, stop);
}

std::vector<ReproduceRow> radar_series(const ReproduceOptions& options, const Stop& stop) {
  constexpr double swarm = 100, step = 25;  // r_s, d_p [px]
  std::vector<ReproduceRow> rows;
  std::vector<Plot> plots;
  for (const Sweep& sweep : series) {
    const double between = options.quick ? 20 : 10;
    Series curve{.label = "ours"};
    for (double r = sweep.first; r <= sweep.last && !stop(); r += between) {
      RadarSetting s = load_radar(options, "single.yaml");
      s.params().safety_distance = sweep.safety.value_or(r) - swarm - step;
      s.params().detection_range = sweep.detection.value_or(r) - swarm;
      curve.x.push_back(r);
      curve.y.push_back(record_of(s, stop).result.metrics.avoidance.mean_cost);
    }
    if (stop()) return rows;
    const auto row = [&](const char* what, double ours, std::optional<double> aim) {
      rows.push_back(
          row_of("fig7", fmt::format("{}: {}", sweep.name, what), "1", {}, ours, aim, false));
    };
    row("mean cost at the smallest", curve.y.front(), {});
    row("mean cost at the largest", curve.y.back(), {});
    row("rises from the smallest to the largest (1: yes)", curve.y.back() > curve.y.front(), 1);
    plots.push_back({.title = sweep.name,
                     .x_label = "radius (px)",
                     .y_label = "mean avoidance cost",
                     .series = {curve},
                     .y_min = 0});
  }
  if (!options.out.empty()) write_everywhere(plots, fs::path(options.out) / "fig7");
  return rows;
}

}  // namespace microswarm::cli
