// SPDX-License-Identifier: Apache-2.0
// Figure 13 of [radar]: the micromaze.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/reproduce/radar/radar.hpp"
#include "microswarm/reproduce/radar/radar_picture.hpp"

namespace microswarm::reproduce {
namespace {

/// Time of the frame with the minimum frame_distance(frame).
template <class Distance>
double nearest(const experiment::Record& record, Distance&& frame_distance) {
  return std::min_element(record.frames.begin(), record.frames.end(),
                          [&](const experiment::Frame& a, const experiment::Frame& b) {
                            return frame_distance(a) < frame_distance(b);
                          })
      ->t;
}

/// Middle of the first wait for a valve from t0 [s] on; empty without a wait.
std::optional<double> middle_of_wait(const experiment::Record& record, double t0) {
  const auto waits = [](const experiment::Frame& f) { return f.state == NavigatorState::wait; };
  const auto from = record.frames.begin() + static_cast<std::ptrdiff_t>(frame_at(record, t0));
  const auto begin = std::find_if(from, record.frames.end(), waits);
  if (begin == record.frames.end()) return std::nullopt;
  const auto end = std::find_if_not(begin, record.frames.end(), waits);
  return begin->t + 0.5 * (std::prev(end)->t - begin->t);
}

/// Moments of the figure: the plan, an avoided mover, the wait at the first valve, the passage
/// through it, the passage of the breathing obstacle, the second valve, and the end.
std::vector<double> micromaze_moments(const experiment::Record& record) {
  const experiment::Scenario& scenario = record.scene.scenario;
  const auto& areas = std::get<navigation::RadarParams>(scenario.navigator).wait_zones;
  const auto to_obstacle = [&](std::size_t k) {
    return nearest(record, [&](const experiment::Frame& f) {
      return distance(f.pose.position, placement(scenario.obstacles[k].motion, f.t).pose.position);
    });
  };
  std::vector<double> out{0, record.result.metrics.time};
  const auto add = [&](std::optional<double> t) {
    if (t) out.push_back(*t);
  };
  bool met_mover = false;
  for (std::size_t k = 0; k < scenario.obstacles.size(); ++k) {
    const Shape& shape = scenario.obstacles[k].shape;
    const bool first_mover = std::holds_alternative<DiscShape>(shape) && !met_mover;
    met_mover = met_mover || first_mover;
    if (first_mover || std::holds_alternative<BreathingDisc>(shape)) add(to_obstacle(k));
  }
  double passed = 0;
  for (const navigation::WaitZone& area : areas) {
    add(middle_of_wait(record, passed));
    passed = nearest(
        record, [&](const experiment::Frame& f) { return distance(f.pose.position, area.centre); });
    add(passed);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

std::vector<report::ReproduceRow> radar_micromaze(const ReproduceOptions& options,
                                                  const Stop& stop) {
  constexpr const char* figure = "fig13";
  constexpr const char* outline = "the maze is ours, its outline is only in the figure";
  std::vector<report::ReproduceRow> rows;
  for (const RadarVersion& version : radar_versions) {
    const RadarSetting s = load_radar(options, "micromaze.yaml", version);
    const auto trials = experiment::run_trials(
        s.scene.scenario, s.world, {.trials = options.quick ? 5 : 20, .progress = {}, .vary = {}},
        stop);
    const RadarRun run = run_radar(s.scene, s.world, stop);
    if (stop()) return rows;
    if (!options.out.empty()) {
      const auto stem = std::filesystem::path(options.out) / fmt::format("fig13-{}", version.stem);
      draw_radar_moments(run, s.world, micromaze_moments(run.record),
                         fmt::format("micromaze, {}", version.name), stem);
      write_radar_run(run, stem);
    }
    std::vector<double> times, turning;
    int contacts = 0;
    for (const experiment::TrialResult& t : trials) {
      contacts += t.result.metrics.contacts;
      turning.push_back(degrees(t.result.metrics.turning));
      if (t.result.status == Status::solved) times.push_back(t.result.metrics.time);
    }
    const double share = static_cast<double>(times.size()) / static_cast<double>(trials.size());
    const auto name = [&](const char* what) { return fmt::format("{}, {}", what, version.name); };
    const std::string of = fmt::format("{} runs", trials.size());
    const auto add = [&](const char* what, const char* unit, std::optional<double> ours) {
      rows.push_back(noted(version_row(version, 0, figure, what, unit, {}, ours), of));
    };
    rows.push_back(unjudged_if_quick(
        noted(row_at_least(0, figure, name("goal reached without contact"), "%", 100, 100 * share),
              of),
        options));
    rows.push_back(unjudged_if_quick(
        noted(row_at_most(0, figure, name("contacts"), "1", 0, contacts), of), options));
    rows.push_back(noted(noted(row_without_aim(outline, figure, name("total time, median"), "s",
                                               408.2, median_if_any(times)),
                               of),
                         spread_text(times)));
    add("turning, median", "°", median_if_any(turning));
    rows.push_back(noted(version_row(version, 0, figure, "time spent waiting", "s", {},
                                     run.record.result.metrics.hold_time),
                         "the run that is drawn"));
    rows.push_back(noted(version_row(version, 0, figure, "mean avoidance cost", "1", {},
                                     run.record.result.metrics.avoidance.mean_cost),
                         "the run that is drawn"));
  }
  return rows;
}

}  // namespace microswarm::reproduce
