// SPDX-License-Identifier: Apache-2.0
// Figures 5, 6 and 10 of [radar]: one obstacle that approaches the swarm from above.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/radar/radar.hpp"
#include "microswarm/reproduce/radar/radar_picture.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr double begun = 0.01;  // smaller avoidance costs are rounding errors of directions
constexpr double noise = 1;     // [µm] of an observed position
constexpr const char* fitted_to =
    "places, speeds, radius and gains fitted to the costs and times of Fig 5 and 6 and to Fig 7";

/// One case with the paper's values. The obstacle enters when "the avoidance cost becomes larger
/// than 0".
struct Case {
  const char* name;
  double safety_distance;                                // d_f [px]
  double detection_range;                                // d_r [px]
  std::optional<double> entered, left, total, avoiding;  // [s]
  double cost;
};

/// Three cases with the same geometry.
struct CaseFigure {
  const char* name;
  const char* scenario;
  double um_per_px;
  double between;   // time of a picture between entering and leaving [s]
  const char* fit;  // description of fitted parameters
  bool has_noise;   // its trials differ because of noise
  std::array<Case, 3> cases;
};

constexpr CaseFigure simulated{"fig5-6",
                               "single_printed.yaml",
                               1,
                               28,
                               fitted_to,
                               false,
                               {{{"Case I", 25, 70, 12.1, 30.6, 48.8, 18.5, 0.14},
                                 {"Case II", 25, 250, 7.9, 37.3, 51.9, 29.4, 0.18},
                                 {"Case III", 205, 250, 7.9, 39.0, 58.6, 31.1, 0.28}}}};
constexpr CaseFigure experiments{"fig10",
                                 "experiment_single.yaml",
                                 radar_um_per_px,
                                 20,
                                 "goal and the obstacle's start fitted to the five numbers of this "
                                 "figure, gains to Fig 5 to 7",
                                 true,
                                 {{{"Case I", 25, 70, 11.1, 32.8, {}, {}, 0.15},
                                   {"Case II", 25, 250, {}, {}, {}, {}, 0.24},
                                   {"Case III", 205, 250, {}, {}, {}, {}, 0.29}}}};

RadarSetting case_setting(const CaseFigure& figure, const Case& c, const RadarVersion& version,
                          const ReproduceOptions& options) {
  RadarSetting s = load_radar(options, figure.scenario, version);
  s.params().safety_distance = c.safety_distance * figure.um_per_px;
  s.params().detection_range = c.detection_range * figure.um_per_px;
  return s;
}

double mean_cost(const RadarRun& run) { return run.record.result.metrics.avoidance.mean_cost; }

/// From the first to the last moment with the obstacle in the detection circle.
Period detected_period(const experiment::Record& record) {
  const std::vector<Period> periods = periods_detected(record);
  return periods.empty() ? Period{} : Period{periods.front().from, periods.back().to};
}

/// Rows of one case and version.
class CaseRows {
 public:
  CaseRows(const CaseFigure& figure, const Case& c, const RadarVersion& version,
           std::vector<report::ReproduceRow>& rows)
      : figure_(figure), case_(c), version_(version), rows_(rows) {}

  void add_run(const RadarRun& run) {
    const experiment::Metrics& m = run.record.result.metrics;
    const Period period = detected_period(run.record);
    add(near_cost, "mean avoidance cost", "1", case_.cost, m.avoidance.mean_cost, figure_.fit);
    add(near_time, "total time", "s", case_.total,
        run.crossed() ? std::optional(m.time) : std::nullopt, figure_.fit);
    add(near_time, "avoidance time", "s", case_.avoiding, m.avoidance.time);
    add(near_time, "obstacle enters the detection circle", "s", case_.entered, period.from);
    add(near_time, "avoidance cost exceeds 0.01", "s", case_.entered,
        cost_above(run.record, begun));
    add(near_time, "obstacle leaves the detection circle", "s", case_.left, period.to);
    add(0, "least gap", "µm", {}, m.avoidance.min_gap);
    add(0, "turning", "°", {}, degrees(m.turning));
  }

  /// Sensitivity: many seeds with slightly noisy positions.
  void add_spread(RadarSetting s, int side, const ReproduceOptions& options, const Stop& stop) {
    if (!figure_.has_noise) s.scene.scenario.sensing.position_noise = noise;
    const std::size_t runs = options.quick ? 10 : 20;
    std::vector<double> times(runs), costs(runs);
    std::vector<int> same(runs);
    for_each_index(runs, 0, [&](std::size_t k) {
      if (stop()) return;
      const RadarRun run = run_radar(s.scene, s.world, stop, static_cast<std::uint32_t>(k));
      times[k] = run.record.result.metrics.time;
      costs[k] = run.record.result.metrics.avoidance.mean_cost;
      same[k] = run.crossed() && side_passed(run.record) == side;
    });
    if (stop()) return;
    const std::string of =
        fmt::format("{} runs", runs) + (figure_.has_noise ? "" : ", places seen 1 µm uncertain");
    add(near_cost, "mean avoidance cost, median over seeds", "1", case_.cost, median(costs), of,
        spread_text(costs));
    add(near_time, "total time, median over seeds", "s", case_.total, median(times), of,
        spread_text(times));
    const auto share =
        static_cast<double>(std::count(same.begin(), same.end(), 1)) / static_cast<double>(runs);
    add(0, "passes on the same side as the run that is drawn", "%", {}, 100 * share, of);
  }

 private:
  void add(double share, const char* what, const char* unit, std::optional<double> paper,
           std::optional<double> ours, std::string_view note = "", std::string_view more = "") {
    rows_.push_back(
        noted(noted(version_row(version_, share, figure_.name,
                                fmt::format("{}: {}", case_.name, what), unit, paper, ours),
                    note),
              more));
  }

  const CaseFigure& figure_;
  const Case& case_;
  const RadarVersion& version_;
  std::vector<report::ReproduceRow>& rows_;
};

/// Draws curves of both versions, and moments of the published one.
void draw(const CaseFigure& figure, const RadarVersion& version, const std::vector<RadarRun>& runs,
          const std::vector<RadarSetting>& settings, const fs::path& folder) {
  double most = 0;
  for (const RadarRun& run : runs)
    for (const experiment::Frame& frame : run.record.frames)
      most = std::max(most, frame.avoidance_cost);
  std::vector<report::Plot> plots;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Case& c = figure.cases[k];
    const std::string title = fmt::format("{}, {}", c.name, version.name);
    plots.push_back(cost_plot(runs[k], title, c.cost, 1.1 * most));
    if (c.entered) plots.back().marks.push_back({"paper: enters", *c.entered});
    if (c.left) plots.back().marks.push_back({"paper: leaves", *c.left});
    const fs::path stem = folder / fmt::format("{}-case{}-{}", figure.name, k + 1, version.stem);
    write_radar_run(runs[k], stem);
    if (!version.as_published) continue;
    const Period period = detected_period(runs[k].record);
    const std::array<double, 5> moments{0, period.from, figure.between, period.to,
                                        runs[k].record.result.metrics.time};
    draw_radar_moments(runs[k], settings[k].world, moments, title, stem,
                       part_that_matters(runs[k], settings[k].world, moments));
  }
  report::write_plots_everywhere(plots,
                                 folder / fmt::format("{}-cost-{}", figure.name, version.stem));
}

/// The three cases of both versions: rows, δ over time, pictures.
std::vector<report::ReproduceRow> cases(const CaseFigure& figure, const ReproduceOptions& options,
                                        const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  for (const RadarVersion& version : radar_versions) {
    std::vector<RadarRun> runs;
    std::vector<RadarSetting> settings;
    int contacts = 0;
    for (const Case& c : figure.cases) {
      settings.push_back(case_setting(figure, c, version, options));
      runs.push_back(run_radar(settings.back().scene, settings.back().world, stop));
      if (stop()) return rows;
      CaseRows out(figure, c, version, rows);
      out.add_run(runs.back());
      out.add_spread(settings.back(), side_passed(runs.back().record), options, stop);
      contacts += runs.back().record.result.metrics.contacts + !runs.back().crossed();
    }
    if (stop()) return rows;
    // The greater detection circle alone: the aims of the two costs overlap.
    rows.push_back(version_row(
        version, near_time, figure.name, "mean avoidance cost, Case II ÷ Case I", "1",
        figure.cases[1].cost / figure.cases[0].cost, mean_cost(runs[1]) / mean_cost(runs[0])));
    rows.push_back(row_at_most(0, figure.name,
                               fmt::format("contacts, or goals not reached, {}", version.name), "1",
                               0, contacts));
    if (!options.out.empty()) draw(figure, version, runs, settings, options.out);
  }
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> radar_single(const ReproduceOptions& options, const Stop& stop) {
  return cases(simulated, options, stop);
}

std::vector<report::ReproduceRow> radar_experiment(const ReproduceOptions& options,
                                                   const Stop& stop) {
  return cases(experiments, options, stop);
}

}  // namespace microswarm::reproduce
