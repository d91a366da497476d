// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/planning/common/detection.hpp"
#include "microswarm/report/decision_marks.hpp"
#include "microswarm/report/latency_rows.hpp"
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/report/robots_report.hpp"
#include "microswarm/report/run_picture.hpp"
#include "microswarm/report/run_plots.hpp"

namespace microswarm::report {
namespace {

constexpr int moments = 3;  // planning events with a picture

struct RunSubject {
  const experiment::Record& record;
  const ReportOptions& options;
  World world;
  const experiment::Scenario& scenario() const { return record.scene.scenario; }
  std::string title() const { return default_title(record); }
};

std::vector<Vec2> trail(const experiment::Record& record, double until) {
  std::vector<Vec2> points;
  for (const experiment::Frame& f : record.frames)
    if (f.t <= until) points.push_back(f.pose.position);
  return points;
}

/// The whole map, or the surroundings of the swarm if the map is much larger.
Box around(const RunSubject& s, const experiment::Frame& frame,
           const experiment::PlanEvent& event) {
  const Box map = s.world.map->bounds();
  double reach = 25 * frame.radius;
  for (const Vec2 p : event.plan.path)
    reach = std::max(reach, 2 * distance(p, frame.pose.position));
  if (4 * reach > std::max(map.width(), map.height())) return map;
  const Vec2 half{reach, 0.65 * reach};
  return {frame.pose.position - half, frame.pose.position + half};
}

void moment(const RunSubject& s, const experiment::PlanEvent& event,
            const std::filesystem::path& stem) {
  const experiment::Frame& frame = frame_at(s.record, event.t);
  Picture picture(around(s, frame, event),
                  fmt::format("{} at {:.1f} s: local target, tree and path", s.title(), event.t));
  draw_ground(picture, *s.world.map, s.options);
  picture.bodies(s.world.at(event.t).moving().bodies());
  for (const Detection& d : event.plan.detections) picture.circle(d.circle, colours::circle, 1);
  picture.tree(event.plan.tree);
  picture.line(trail(s.record, event.t), {0.0, 0.45, 0.70, 0.35}, 2.5);
  picture.line(event.plan.path, colours::path, 3);
  picture.swarm(frame.pose, frame.radius);
  if (frame.target) picture.mark(*frame.target, "local target", colours::circle);
  const experiment::Scenario scenario = experiment::scenario_at(s.record, event.t);
  draw_decision(picture, decision_at(s.record, event.t), scenario, frame.pose.position);
  draw_ends(picture, scenario);
  picture.legend("swarm", colours::swarm, true);
  picture.legend("planned path", colours::path);
  picture.legend("tree", colours::tree);
  picture.legend("detection circles", colours::circle);
  if (!s.world.obstacles.empty()) picture.legend("moving obstacles", colours::obstacle, true);
  picture.write_everywhere(stem);
}

std::string moment_caption(const RunSubject& s, std::size_t number,
                           const experiment::PlanEvent& event) {
  const experiment::Frame& frame = frame_at(s.record, event.t);
  std::string text = fmt::format("{}: at {:.1f} s", number, event.t);
  if (std::isfinite(frame.obstacle_clearance))
    text += fmt::format(", {:.0f} µm from the nearest obstacle", frame.obstacle_clearance);
  if (!std::isfinite(frame.wall_clearance)) return text;
  return text + fmt::format(", {:.0f} µm from the nearest wall", frame.wall_clearance);
}

/// The planning event in a range at which an obstacle is nearest.
const experiment::PlanEvent& tightest(const experiment::Record& record, std::size_t first,
                                      std::size_t end) {
  const auto clearance = [&](const experiment::PlanEvent& e) {
    return frame_at(record, e.t).obstacle_clearance;
  };
  return *std::min_element(record.plans.begin() + static_cast<std::ptrdiff_t>(first),
                           record.plans.begin() + static_cast<std::ptrdiff_t>(end),
                           [&](const experiment::PlanEvent& a, const experiment::PlanEvent& b) {
                             return clearance(a) < clearance(b);
                           });
}

/// The status; for a run that ended while holding, also the navigator's last state.
std::string ended(const experiment::Record& record) {
  std::string text(to_string(record.result.status));
  const std::size_t frames = record.frames.size();
  if (record.result.status == Status::held && frames > 1)
    text += fmt::format(" ({})", enum_name(record.frames[frames - 2].state));
  return text;
}

std::vector<std::vector<std::string>> run_numbers(const experiment::Record& record) {
  const experiment::Metrics& m = record.result.metrics;
  const experiment::TimeSummary p = experiment::summarise(record.result.timing.planning);
  const auto um = [](double v) { return std::isfinite(v) ? fmt::format("{:.1f} µm", v) : "–"; };
  return {{"quantity", "value"},
          {"ended", ended(record)},
          {"time", fmt::format("{:.1f} s", m.time)},
          {"path length", um(m.length)},
          {"total turning", fmt::format("{:.0f}°", degrees(m.turning))},
          {"least distance of the centre to walls", um(m.walls.clearance)},
          {"least distance of the centre to obstacles", um(m.obstacles.clearance)},
          {"time with an obstacle in range", fmt::format("{:.1f} s", m.avoidance.time)},
          {"mean avoidance cost δ", fmt::format("{:.4g}", m.avoidance.mean_cost)},
          {"mean gap to the nearest obstacle in that time",
           m.avoidance.time > 0 ? um(m.avoidance.mean_gap) : "–"},
          {"least gap to an obstacle", um(m.avoidance.min_gap)},
          {"time held", fmt::format("{:.1f} s", m.hold_time)},
          {"planning events", fmt::format("{}", m.planning_events)},
          {"planning time, mean ± sd",
           p.count > 0 ? fmt::format("{:.3f} ± {:.3f} ms", 1e3 * p.mean, 1e3 * p.sd) : "–"},
          {"planning time, longest", p.count > 0 ? fmt::format("{:.3f} ms", 1e3 * p.max) : "–"},
          {"rig", record.rig.empty() ? "none: simulated" : record.rig},
          {"seed, trial", fmt::format("{}, {}", record.scene.scenario.seed, record.trial)},
          {"version", record.version},
          {"inputs", record.scene.hash()},
          {"record", record.hash()}};
}

}  // namespace

void write_run_report(const experiment::Record& record, const std::filesystem::path& folder,
                      const ReportOptions& options) {
  if (record.frames.empty()) throw InputError("the record has no frames to report");
  if (record.scene.scenario.robots) return write_robots_report(record, folder, options);
  const RunSubject s{record, options, experiment::build_world(record.scene)};
  PageSection stills{.heading = "Moments",
                     .text =
                         "In each third of the run the planning event at which an obstacle was "
                         "nearest; numbered in the picture above. Also as .svg and .pdf."};
  const std::size_t events = record.plans.size();
  const std::size_t shown = std::min<std::size_t>(moments, events);
  std::vector<const experiment::PlanEvent*> chosen;
  for (std::size_t k = 0; k < shown; ++k)
    chosen.push_back(&tightest(record, k * events / shown, (k + 1) * events / shown));
  draw_run(record, options, chosen)->write_everywhere(folder / "overview");
  for (std::size_t k = 0; k < shown; ++k) {
    const std::string stem = fmt::format("moment-{}", k + 1);
    moment(s, *chosen[k], folder / stem);
    stills.pictures.emplace_back(stem + ".png", moment_caption(s, k + 1, *chosen[k]));
  }
  write_plots(run_plots(record), folder / "plots.png");
  auto numbers = run_numbers(record);
  add_latency_rows(numbers, record);
  std::vector<PageSection> sections{
      {.text = s.scenario().description,
       .pictures = {{"overview.png", "The whole run. Also as overview.svg and overview.pdf."}}},
      {.heading = "Numbers", .table = std::move(numbers)}};
  if (shown > 0) sections.push_back(std::move(stills));
  const bool planned = !record.result.timing.planning.empty();
  sections.push_back(
      {.heading = "Over time",
       .pictures = {
           {"plots.png", planned ? "Planning times are wall-clock times of this machine." : ""}}});
  write_page(folder / "index.html", s.title(), sections);
}

}  // namespace microswarm::report
