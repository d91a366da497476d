// SPDX-License-Identifier: Apache-2.0
// The worlds of DynaBARN, at the benchmark's speed and at half of it, where obstacles are up to
// 1.95 times as fast as the robot.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/arena/driven_run.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/scenes/dynabarn.hpp"

namespace microswarm::reproduce {
namespace {

constexpr double dynabarn_clearance = 42;  // of the robot of 30 µm [µm]

/// Conditions of a crossing.
struct DynabarnCourse {
  const char* name;
  double speed;       ///< [µm/s]
  bool bad_sight;     ///< with noise, and 0.15 s late
  double min_solved;  ///< aim for the recommended navigator, of 60
};
constexpr std::array<DynabarnCourse, 3> dynabarn_courses{
    {{"2 m/s", 200, false, 60},
     {"1 m/s", 100, false, 59},
     {"1 m/s, noisy and late", 100, true, 57}}};
constexpr double max_hard_time = 25;  // aim at 1 m/s [s]

experiment::Scenario course_scenario(const scenes::DynabarnWorld& world,
                                     const DynabarnCourse& course) {
  experiment::Scenario scenario = scenes::dynabarn_scenario(world, course.speed);
  if (course.bad_sight) {
    scenario.sensing.observation_delay = 0.15;
    scenario.sensing.position_noise = 1;
    scenario.sensing.obstacle_noise = 3;
  }
  return scenario;
}

void add_dynabarn_rows(const std::vector<scenes::DynabarnWorld>& worlds,
                       const std::vector<DrivenRun>& runs, const DynabarnCourse& course,
                       const DrivenNavigator& navigator, const ReproduceOptions& options,
                       std::vector<report::ReproduceRow>& rows) {
  std::array<int, 3> solved{}, of_level{};
  int all = 0, avoidable = 0;
  std::vector<double> hard_times;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const auto level = static_cast<std::size_t>(worlds[i].level);
    ++of_level[level];
    avoidable += runs[i].avoidable > 0;
    if (!runs[i].arrived()) continue;
    ++solved[level];
    ++all;
    if (worlds[i].level == scenes::DynabarnLevel::hard) hard_times.push_back(runs[i].time);
  }
  const auto add = [&](const char* what, const char* unit, std::optional<double> ours,
                       std::optional<double> aim, bool at_most, const std::string& note) {
    if (!navigator.is_recommended) aim.reset();
    rows.push_back(unjudged_if_quick(
        noted(make_row("dynabarn", fmt::format("{}, {}: {}", course.name, navigator.name, what),
                       unit, {}, ours, aim, at_most),
              note + (aim ? "; aim is ours" : "")),
        options));
  };
  add("crossed", "", all, course.min_solved, false,
      fmt::format("easy {} of {}, medium {} of {}, hard {} of {}", solved[0], of_level[0],
                  solved[1], of_level[1], solved[2], of_level[2]));
  add("avoidable contact", "", avoidable, {}, true,
      share_text(avoidable, static_cast<int>(runs.size())));
  const bool has_aim = course.speed == 100 && !course.bad_sight;
  add("time in hard worlds, median", "s", median_if_any(hard_times),
      has_aim ? std::optional(max_hard_time) : std::nullopt, true, "of those that arrive");
}

std::vector<report::ReproduceRow> dynabarn(const ReproduceOptions& options, const Stop& stop) {
  const auto tracks = data_file(options, "dynabarn/tracks.csv", "dynabarn");
  if (!tracks) return {};
  std::vector<scenes::DynabarnWorld> worlds = scenes::read_dynabarn(tracks->parent_path());
  if (options.quick) {
    constexpr std::size_t pitch = 20;  // one of each level
    for (std::size_t i = 0; pitch * i < worlds.size(); ++i) worlds[i] = worlds[pitch * i];
    worlds.resize((worlds.size() + pitch - 1) / pitch);
  }
  std::vector<report::ReproduceRow> rows;
  const std::size_t courses = options.quick ? 1 : dynabarn_courses.size();
  for (const DynabarnCourse& course : std::span(dynabarn_courses).first(courses))
    for (const DrivenNavigator& navigator : driven_navigators()) {
      const Progress bar(options.progress,
                         fmt::format("dynabarn: {}, {}", course.name, navigator.name));
      std::vector<DrivenRun> runs(worlds.size());
      for_each_index(worlds.size(), 0, [&](std::size_t i) {
        if (stop()) return;
        experiment::Scenario scenario = course_scenario(worlds[i], course);
        scenario.seed = i + 1;
        scenario.navigator = navigator.params({course.speed, dynabarn_clearance});
        runs[i] = drive(scenario, scenes::avoidance_world(scenario), stop);
      });
      if (stop()) return rows;
      add_dynabarn_rows(worlds, runs, course, navigator, options, rows);
    }
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> dynabarn_figures(const std::string& figure,
                                                   const ReproduceOptions& options,
                                                   const Stop& stop) {
  constexpr Figure figures[] = {{"all", dynabarn}};
  return reproduce_figures("dynabarn", figures, figure, options, stop);
}

}  // namespace microswarm::reproduce
