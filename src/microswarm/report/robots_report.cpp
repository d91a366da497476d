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
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/report/plot.hpp"

namespace microswarm {
namespace {

constexpr std::size_t max_numbered = 8;  // robots with their own colour and number

struct RobotsSubject {
  const Record& record;
  const ReportOptions& options;
  World world;
  const Scenario& scenario() const { return record.scene.scenario; }
  std::string title() const { return title_of(record); }
  bool few() const { return scenario().robots->starts.size() - 1 < max_numbered; }
};

Colour colour_of(const RobotsSubject& s, std::size_t robot) {
  return s.few() ? colours::robots[robot % colours::robots.size()] : colours::swarm;
}

/// Robots drawn as one spot because they would overlap.
struct Pile {
  Vec2 place;
  int count = 0;
};

std::vector<Pile> piles_of(const std::vector<Vec2>& places, double spot) {
  std::map<std::pair<int, int>, Pile> by_cell;
  for (const Vec2 p : places) {
    Pile& pile = by_cell[{static_cast<int>(p.x / spot), static_cast<int>(p.y / spot)}];
    pile.place += p;
    ++pile.count;
  }
  std::vector<Pile> piles;
  piles.reserve(by_cell.size());
  for (const auto& [cell, pile] : by_cell)
    piles.push_back({pile.place / static_cast<double>(pile.count), pile.count});
  return piles;
}

void draw_robots(Picture& picture, const RobotsSubject& s, const std::vector<Vec2>& places) {
  if (s.few()) {
    for (std::size_t i = 0; i < places.size(); ++i) picture.disc({places[i], 0}, colour_of(s, i));
    return;
  }
  const Box& box = s.world.map->bounds();
  const double pixel = std::max(box.width(), box.height()) / 1200;  // [µm] of the picture
  for (const Pile& pile : piles_of(places, 6 * pixel))
    picture.disc({pile.place, pixel * (3 + 0.8 * std::sqrt(pile.count))}, colours::swarm);
  picture.legend("robots; a larger spot is a pile of them", colours::swarm, true);
}

/// Draws the paths of a few robots from the recorded moments.
void draw_ways(Picture& picture, const RobotsSubject& s, double until) {
  if (!s.few()) return;
  for (std::size_t i = 0; i < s.record.robots.front().places.size(); ++i) {
    std::vector<Vec2> way;
    for (const RobotMoment& m : s.record.robots)
      if (m.t <= until) way.push_back(m.places[i]);
    picture.line(way, colour_of(s, i), 1.5);
  }
}

void draw_goals(Picture& picture, const RobotsSubject& s) {
  const Scenario& scenario = s.scenario();
  for (std::size_t i = 0; i < scenario.robots->goals.size(); ++i)
    picture.circle({scenario.robots->goals[i], scenario.goal_tolerance}, colour_of(s, i), 2);
  if (scenario.goal) picture.mark(*scenario.goal, "goal", colours::goal);
}

void draw(const RobotsSubject& s, const RobotMoment& moment, const std::string& what,
          const std::filesystem::path& file) {
  Picture picture(s.world.map->bounds(), fmt::format("{}: {}", s.title(), what));
  draw_ground(picture, *s.world.map, s.options);
  draw_ways(picture, s, moment.t);
  draw_robots(picture, s, moment.places);
  draw_goals(picture, s);
  picture.write(file);
}

Plot left_over_time(const RobotsSubject& s) {
  const bool each = !s.scenario().robots->goals.empty();
  Plot plot{.title = each ? "The worst robot's distance from its goal" : "Mean way to the goal, F",
            .x_label = "time (s)",
            .y_label = "distance (µm)"};
  Series left{.label = each ? "worst robot" : "F"};
  for (const Frame& f : s.record.frames) {
    left.x.push_back(f.t);
    left.y.push_back(f.goal_distance);
  }
  plot.series = {left};
  plot.levels = {{"goal tolerance", s.scenario().goal_tolerance}};
  plot.y_min = 0;
  return plot;
}

std::vector<std::vector<std::string>> robots_numbers(const Record& record) {
  const Metrics& m = record.result.metrics;
  return {{"quantity", "value"},
          {"ended", std::string(to_string(record.result.status))},
          {"robots", fmt::format("{}", record.robots.front().places.size())},
          {"time", fmt::format("{:.1f} s", m.time)},
          {"commands", fmt::format("{}", record.frames.size() - 1)},
          {"left to the goal", fmt::format("{:.1f} µm", m.goal_distance)},
          {"time held", fmt::format("{:.1f} s", m.hold_time)},
          {"planning events", fmt::format("{}", m.planning_events)},
          {"rig", record.rig.empty() ? "none: simulated" : record.rig},
          {"seed, trial", fmt::format("{}, {}", record.scene.scenario.seed, record.trial)},
          {"version", record.version},
          {"inputs", record.scene.hash()},
          {"record", record.hash()}};
}

}  // namespace

void write_robots_report(const Record& record, const std::filesystem::path& folder,
                         const ReportOptions& options) {
  if (record.frames.empty() || record.robots.empty())
    throw InputError("the record has no frames to report");
  const RobotsSubject s{record, options, build_world(record.scene)};
  const std::vector<RobotMoment>& moments = record.robots;
  PageSection stills{.heading = "Moments"};
  const std::array<std::pair<const char*, std::size_t>, 3> shown{
      {{"before.png", 0},
       {"half-way.png", (moments.size() - 1) / 2},
       {"after.png", moments.size() - 1}}};
  for (const auto& [name, k] : shown) {
    const std::string what =
        fmt::format("{} robots at {:.1f} s", moments[k].places.size(), moments[k].t);
    draw(s, moments[k], what, folder / name);
    stills.pictures.emplace_back(name, what);
  }
  write_plots({left_over_time(s)}, folder / "plots.png");
  write_page(folder / "index.html", s.title(),
             {{.text = s.scenario().description},
              stills,
              {.heading = "Numbers", .table = robots_numbers(record)},
              {.heading = "Over time", .pictures = {{"plots.png", ""}}}});
}

}  // namespace microswarm
