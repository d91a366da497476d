// SPDX-License-Identifier: Apache-2.0
// The claim of [drrt]: smoother and shorter paths than the radar of [radar] among moving obstacles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/drrt/drrt.hpp"

namespace microswarm::reproduce {
namespace {

constexpr double kept_margin = 90;      // of all navigators, from the centre [µm]
constexpr double field_amplitude = 10;  // amplitude of the oscillating field [mT]
// The radar checks a point one prediction distance ahead, not the sides. Of 50, 70, 90, 110 and 130
// µm this is the smallest distance with which it keeps the margin in four of five trials.
constexpr double wide_prediction = 130;
constexpr double sight_noise = 2;      // of an obstacle's position [µm]
constexpr double sight_missed = 0.02;  // fraction of the frames
constexpr double enough = 0.9;  // minimum fraction of arrivals for which medians are meaningful
constexpr double max_turning = 500;  // aim [°]
constexpr int all_trials = 100, quick_trials = 30;

struct ComparedFramework {
  const char* name;
  const char* tick;  ///< label in plots
  navigation::NavigatorParams params;
  std::size_t colour;
  bool noisy = false;     ///< with detection noise and dropouts
  bool held_out = false;  ///< on trials not used for any choice
};

/// The radar with circles for a given margin: the checked point, one prediction distance ahead, is
/// free of obstacles within radius plus prediction distance.
navigation::RadarParams radar(const navigation::HierarchicalParams& drrt,
                              double prediction_distance, bool as_published) {
  navigation::RadarParams params;
  params.speed = drrt.speed;
  params.prediction_distance = prediction_distance;
  params.safety_distance = prediction_distance;
  params.detection_range = 3 * prediction_distance;
  params.as_published = as_published;
  return params;
}

std::vector<ComparedFramework> list_contestants(const experiment::Scenario& scenario) {
  const double radius = swarm_limits(scenario.swarm).radius;
  const auto& ours = std::get<navigation::HierarchicalParams>(scenario.navigator);
  navigation::HierarchicalParams published = ours;
  published.as_published = true;
  namespace colour = report::method_colours;
  return {
      {"D-RRT*, as published", "D-RRT* publ.", published, colour::drrt_star},
      {"D-RRT*, ours", "D-RRT* ours", ours, colour::drrt_star},
      {"radar, as published", "radar publ.", radar(ours, kept_margin - radius, true),
       colour::radar},
      {"radar, ours", "radar ours", radar(ours, kept_margin - radius, false), colour::radar},
      {"wide radar, as published", "wide publ.", radar(ours, wide_prediction, true), colour::radar},
      {"wide radar, ours", "wide ours", radar(ours, wide_prediction, false), colour::radar},
      {"D-RRT*, ours, noisy sight", "D-RRT* noisy", ours, colour::drrt_star, true},
      {"wide radar, ours, noisy sight", "wide noisy", radar(ours, wide_prediction, false),
       colour::radar, true},
      {"D-RRT*, ours, held-out trials", "D-RRT* held out", ours, colour::drrt_star, false, true}};
}

/// One value per trial that arrived.
struct Study {
  std::vector<double> turning, length, time, energy;  // [°, µm, s, mT²·s]
  std::vector<double> least;                          // of every trial [µm]
  int arrived = 0, kept = 0;
  double shortest = 0;  ///< [µm]
};

Study study(const std::vector<experiment::TrialResult>& trials, double shortest) {
  Study out{.shortest = shortest};
  for (const experiment::TrialResult& t : trials) {
    const experiment::Metrics& m = t.result.metrics;
    out.least.push_back(m.obstacles.clearance);
    out.kept += m.obstacles.clearance >= kept_margin;
    if (t.result.status != Status::solved) continue;
    ++out.arrived;
    out.turning.push_back(degrees(m.turning));
    out.length.push_back(m.length);
    out.time.push_back(m.time);
    // Mean square of an oscillating field while the swarm is driven.
    out.energy.push_back(0.5 * field_amplitude * field_amplitude * (m.time - m.hold_time));
  }
  return out;
}

/// Rows of one navigator; with `aimed`, ours have aims of our own.
void add_rows(const char* name, const Study& s, bool aimed,
              std::vector<report::ReproduceRow>& rows) {
  const auto add = [&](const char* what, const char* unit, std::optional<double> ours) {
    rows.push_back(
        row_without_aim("", "comparison", fmt::format("{}: {}", name, what), unit, {}, ours));
  };
  const auto aim = [&](double value, bool at_most) {
    if (!aimed) return;
    rows.back().aim = value;
    rows.back().at_most = at_most;
    rows.back() = noted(std::move(rows.back()), "aim is ours");
  };
  const auto n = static_cast<double>(s.least.size());
  add("arrived without contact", "%", 100 * s.arrived / n);
  aim(100, false);
  add("margin of 90 µm kept", "%", 100 * s.kept / n);
  aim(100, false);
  add("least distance, median", "µm", median_if_any(s.least));
  add("least distance of all trials", "µm",
      s.least.empty() ? std::nullopt
                      : std::optional(*std::min_element(s.least.begin(), s.least.end())));
  add("turning, median", "°", median_if_any(s.turning));
  aim(max_turning, true);
  add("path length, median", "µm", median_if_any(s.length));
  add("length over the shortest among walls alone, median", "%",
      over_the_shortest(s.length, s.shortest));
  add("time, median", "s", median_if_any(s.time));
  add("energy of the field, median", "mT²·s", median_if_any(s.energy));
}

/// The claim as a row: reduction of D-RRT*'s median relative to the radar's.
report::ReproduceRow claim(const char* what, const ComparedFramework& drrt, const Study& of_drrt,
                           const ComparedFramework& radar, const Study& of_radar,
                           std::vector<double> Study::*measure) {
  const std::vector<double>& a = of_drrt.*measure;
  const std::vector<double>& b = of_radar.*measure;
  std::optional<double> less;
  if (!a.empty() && !b.empty()) less = percent_less(median(a), median(b));
  report::ReproduceRow row =
      noted(make_row("comparison", fmt::format("{} {} than {}", drrt.name, what, radar.name), "%",
                     {}, less, 0, false),
            "claimed without a figure");
  const auto share = [](const Study& s) { return s.arrived / static_cast<double>(s.least.size()); };
  if (std::min(share(of_drrt), share(of_radar)) >= enough) return row;
  return unjudged(std::move(row), "medians of too few that arrive");
}

void plot_study(const std::vector<ComparedFramework>& who, const std::vector<Study>& studies,
                const std::filesystem::path& folder) {
  std::vector<report::Plot> plots{
      {.title = "Turning", .y_label = "total turning (°)", .log_y = true},
      {.title = "Path length", .y_label = "path length (µm)"},
      {.title = "Time", .y_label = "time (s)"},
      {.title = "Least distance, centre to obstacle",
       .y_label = "least distance (µm)",
       .levels = {{"margin", kept_margin}}}};
  for (std::size_t k = 0; k < who.size(); ++k) {
    const Study& s = studies[k];
    const std::array<const std::vector<double>*, 4> values{&s.turning, &s.length, &s.time,
                                                           &s.least};
    const double x = static_cast<double>(k + 1);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      if (!values[i]->empty())
        plots[i].series.push_back({who[k].tick, std::vector<double>(values[i]->size(), x),
                                   *values[i], report::PlotStyle::box, who[k].colour});
      plots[i].x_ticks.push_back({who[k].tick, x});
    }
  }
  report::write_plots_everywhere(plots, folder / "comparison");
}

}  // namespace

std::vector<report::ReproduceRow> drrt_comparison(const ReproduceOptions& options,
                                                  const Stop& stop) {
  DrrtSetting s = load_drrt(options, "moving_obstacles.yaml");
  const std::vector<ComparedFramework> who = list_contestants(s.scene.scenario);
  std::vector<Study> studies;
  std::vector<report::ReproduceRow> rows;
  const double shortest = shortest_path_length(s);
  const std::uint64_t seed = s.scene.scenario.seed;
  for (const ComparedFramework& contestant : who) {
    s.scene.scenario.seed = contestant.held_out ? seed + 1 : seed;
    s.scene.scenario.navigator = contestant.params;
    s.scene.scenario.sensing.obstacle_noise = contestant.noisy ? sight_noise : 0;
    s.scene.scenario.sensing.obstacle_missed_share = contestant.noisy ? sight_missed : 0;
    const Progress bar(options.progress, fmt::format("comparison: {}", contestant.name));
    const auto trials = experiment::run_trials(
        s.scene.scenario, s.world,
        {.trials = options.quick ? quick_trials : all_trials,
         .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); },
         .vary = vary_phases},
        stop);
    if (stop()) return rows;  // do not report interrupted studies
    studies.push_back(study(trials, shortest));
    add_rows(contestant.name, studies.back(), &contestant == &who[1], rows);
  }
  for (std::size_t k = 2; k < 6; ++k) {
    const std::size_t drrt = k % 2;  // compare published with published, ours with ours
    rows.push_back(
        claim("turns less", who[drrt], studies[drrt], who[k], studies[k], &Study::turning));
    rows.push_back(
        claim("is shorter", who[drrt], studies[drrt], who[k], studies[k], &Study::length));
  }
  for (report::ReproduceRow& row : rows)
    if (row.aim) row = unjudged_if_quick(std::move(row), options);
  if (!options.out.empty()) plot_study(who, studies, options.out);
  return rows;
}

}  // namespace microswarm::reproduce
