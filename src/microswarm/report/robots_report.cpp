// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/robots_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/report/decision_marks.hpp"
#include "microswarm/report/latency_rows.hpp"
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/report/robot_marks.hpp"

namespace microswarm::report {
namespace {

struct RobotsSubject {
  const experiment::Record& record;
  const ReportOptions& options;
  World world;
  const experiment::Scenario& scenario() const { return record.scene.scenario; }
  std::string title() const { return default_title(record); }
  bool few() const { return are_few(*scenario().robots); }
};

/// Draws the paths of a few robots from the recorded moments.
void draw_paths(Picture& picture, const RobotsSubject& s, double until) {
  if (!s.few()) return;
  for (std::size_t i = 0; i < s.record.robots.front().positions.size(); ++i) {
    std::vector<Vec2> path;
    for (const experiment::RobotMoment& m : s.record.robots)
      if (m.t <= until) path.push_back(m.positions[i]);
    picture.line(path, robot_colour(*s.scenario().robots, i), 1.5);
  }
}

std::string moment_text(const experiment::RobotMoment& moment) {
  return fmt::format("{} robots at {:.1f} s", moment.positions.size(), moment.t);
}

Plot left_over_time(const RobotsSubject& s) {
  const bool each = !s.scenario().robots->goals.empty();
  Plot plot{
      .title = each ? "The worst robot's distance from its goal" : "Mean distance to the goal, F",
      .x_label = "time (s)",
      .y_label = "distance (µm)"};
  Series left{.label = each ? "worst robot" : "F"};
  for (const experiment::Frame& f : s.record.frames) {
    left.x.push_back(f.t);
    left.y.push_back(f.goal_distance);
  }
  plot.series = {left};
  plot.levels = {{"goal tolerance", s.scenario().goal_tolerance}};
  plot.y_min = 0;
  return plot;
}

std::vector<std::vector<std::string>> robots_numbers(const experiment::Record& record) {
  const experiment::Metrics& m = record.result.metrics;
  return {{"quantity", "value"},
          {"ended", std::string(to_string(record.result.status))},
          {"robots", fmt::format("{}", record.robots.front().positions.size())},
          {"time", fmt::format("{:.1f} s", m.time)},
          {"commands", fmt::format("{}", record.frames.size() - 1)},
          {"distance to the goal", fmt::format("{:.1f} µm", m.goal_distance)},
          {"time held", fmt::format("{:.1f} s", m.hold_time)},
          {"planning events", fmt::format("{}", m.planning_events)},
          {"rig", record.rig.empty() ? "none: simulated" : record.rig},
          {"seed, trial", fmt::format("{}, {}", record.scene.scenario.seed, record.trial)},
          {"version", record.version},
          {"inputs", record.scene.hash()},
          {"record", record.hash()}};
}

}  // namespace

std::unique_ptr<Picture> draw_robots_at(const experiment::Record& record,
                                        const ReportOptions& options, std::size_t moment) {
  const RobotsSubject s{record, options, experiment::build_world(record.scene)};
  const experiment::RobotMoment* const at =
      moment < record.robots.size() ? &record.robots[moment] : nullptr;
  auto picture = std::make_unique<Picture>(
      s.world.map->bounds(), fmt::format("{}: {}", s.title(), at ? moment_text(*at) : "start"));
  draw_ground(*picture, *s.world.map, options);
  if (at) {
    draw_paths(*picture, s, at->t);
    draw_decision(*picture, decision_at(record, at->t), s.scenario(), {}, at->positions);
    draw_robot_marks(*picture, s.scenario(), s.world.map->bounds(), at->positions);
  }
  draw_robot_goals(*picture, experiment::scenario_at(record, at ? at->t : 0));
  return picture;
}

void write_robots_report(const experiment::Record& record, const std::filesystem::path& folder,
                         const ReportOptions& options) {
  if (record.frames.empty() || record.robots.empty())
    throw InputError("the record has no frames to report");
  const RobotsSubject s{record, options, experiment::build_world(record.scene)};
  const std::vector<experiment::RobotMoment>& moments = record.robots;
  PageSection stills{.heading = "Moments"};
  const std::array<std::pair<const char*, std::size_t>, 3> shown{
      {{"before.png", 0},
       {"half-way.png", (moments.size() - 1) / 2},
       {"after.png", moments.size() - 1}}};
  for (const auto& [name, k] : shown) {
    draw_robots_at(record, options, k)->write(folder / name);
    stills.pictures.emplace_back(name, moment_text(moments[k]));
  }
  write_plots({left_over_time(s)}, folder / "plots.png");
  auto numbers = robots_numbers(record);
  add_latency_rows(numbers, record);
  write_page(folder / "index.html", s.title(),
             {{.text = s.scenario().description},
              stills,
              {.heading = "Numbers", .table = std::move(numbers)},
              {.heading = "Over time", .pictures = {{"plots.png", ""}}}});
}

}  // namespace microswarm::report
