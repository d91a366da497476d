// SPDX-License-Identifier: Apache-2.0
// Fig 5 and 6 [drrt]: the complete loop in a deforming channel and among moving obstacles.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/report/run_report.hpp"
#include "microswarm/reproduce/drrt/drrt.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr double published_margin = 90;  // [µm]

struct LoopFigure {
  const char* figure;
  const char* scenario;
  double events, mean, sd, max;  // published [1, ms, ms, ms]
  double less_than_global;  // published reduction of the mean planning time relative to Fig 3 [%]
};

constexpr LoopFigure deforming{"fig5a", "deforming_channel.yaml", 16, 8, 3, 15, 85.5};
constexpr LoopFigure moving{"fig5b", "moving_obstacles.yaml", 34, 44, 41, 100, 20.0};

/// Results of the trials of one setting.
struct Loops {
  std::vector<double> planning;                               // [ms]
  std::vector<double> events, turning, length, time;          // per run; [1, °, µm, s]
  double least = std::numeric_limits<double>::infinity();     // [µm]
  double min_wall = std::numeric_limits<double>::infinity();  // [µm]
  int reached = 0, below = 0;
};

Loops summed(const std::vector<experiment::TrialResult>& trials) {
  Loops out;
  for (const experiment::TrialResult& t : trials) {
    const experiment::Metrics& m = t.result.metrics;
    out.reached += t.result.status == Status::solved;
    out.below += m.obstacles.clearance < published_margin;
    out.least = std::min(out.least, m.obstacles.clearance);
    out.min_wall = std::min(out.min_wall, m.walls.clearance);
    out.events.push_back(m.planning_events);
    for (const double time : t.result.timing.planning) out.planning.push_back(1e3 * time);
    if (t.result.status != Status::solved) continue;
    out.turning.push_back(degrees(m.turning));
    out.length.push_back(m.length);
    out.time.push_back(m.time);
  }
  return out;
}

std::vector<report::ReproduceRow> loop_rows(const LoopFigure& f, const std::string& who,
                                            const Loops& l, double shortest, double global_time) {
  const std::string fig = f.figure;
  const auto named = [&](const char* what) { return who + ": " + what; };
  const experiment::TimeSummary sum = experiment::summarise(l.planning);  // in milliseconds
  const auto n = static_cast<double>(l.events.size());
  const auto plain = [&](const char* what, const char* unit, std::optional<double> paper,
                         std::optional<double> ours, const char* why = "") {
    return row_without_aim(why, fig, named(what), unit, paper, ours);
  };
  constexpr const char* other_machine = "wall clock of another machine";
  return {row_at_least(0, fig, named("goal reached"), "%", 100, 100 * l.reached / n),
          row_at_least(0, fig, named("least distance, centre to obstacles"), "µm", published_margin,
                       l.least),
          plain("runs that come nearer than the margin", "%", {}, 100 * l.below / n),
          plain("least distance, centre to border", "µm", {}, l.min_wall),
          plain("turning, median of runs that arrive", "°", {}, median_if_any(l.turning)),
          plain("path length, median of runs that arrive", "µm", {}, median_if_any(l.length)),
          plain("length over the shortest among walls alone, median", "%", {},
                over_the_shortest(l.length, shortest)),
          plain("time, median of runs that arrive", "s", {}, median_if_any(l.time)),
          plain("planning events per run, median", "1", f.events, median_if_any(l.events),
                "the obstacles' places are ours"),
          plain("planning time, mean", "ms", f.mean, sum.mean, other_machine),
          plain("planning time, sd", "ms", f.sd, sum.sd, other_machine),
          plain("planning time, p99", "ms", {}, sum.p99),
          plain("planning time, max", "ms", f.max, sum.max, other_machine),
          plain("mean planning time less than Fig 3's median", "%", f.less_than_global,
                percent_less(sum.mean, global_time),
                "both are ours, of another machine and another channel")};
}

void loop_pictures(const LoopFigure& f, const std::string& who, const experiment::Scene& scene,
                   const World& world, const fs::path& out, const Stop& stop) {
  experiment::Session session({scene, world, {}});
  session.finish(stop);
  const fs::path folder = out / (f.figure + who);
  make_folder(folder.string());
  experiment::write_record(session.record(), folder / "run.h5");
  report::write_run_report(session.record(), folder);
}

std::vector<report::ReproduceRow> loop_figure(const LoopFigure& f, const ReproduceOptions& options,
                                              const Stop& stop) {
  DrrtSetting s = load_drrt(options, f.scenario);
  const double global_time = drrt_global_planning_time(options, stop);
  std::vector<report::ReproduceRow> rows;
  for (const bool as_published : {true, false}) {
    const std::string who = as_published ? "D-RRT*, as published" : "D-RRT*, ours";
    std::get<navigation::HierarchicalParams>(s.scene.scenario.navigator).as_published =
        as_published;
    const Progress bar(options.progress, fmt::format("{}: {}", f.figure, who));
    // One thread, because planning times are measured.
    const auto trials = experiment::run_trials(
        s.scene.scenario, s.world,
        {.trials = options.seed_count(),
         .jobs = 1,
         .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); },
         .vary = vary_phases},
        stop);
    if (stop()) return rows;  // do not report interrupted trials
    if (!options.out.empty())
      loop_pictures(f, as_published ? "-as-published" : "", s.scene, s.world, options.out, stop);
    for (report::ReproduceRow& row :
         loop_rows(f, who, summed(trials), shortest_path_length(s), global_time))
      rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> drrt_fig5a(const ReproduceOptions& options, const Stop& stop) {
  return loop_figure(deforming, options, stop);
}

std::vector<report::ReproduceRow> drrt_fig5b(const ReproduceOptions& options, const Stop& stop) {
  return loop_figure(moving, options, stop);
}

}  // namespace microswarm::reproduce
