// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/safety.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/reproduce/radar/safety_campaign.hpp"
#include "microswarm/reproduce/radar/safety_tables.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/scenes/pedestrians.hpp"

namespace microswarm::reproduce {
namespace {

constexpr double just_slower = 8;  // for recorded pedestrians: the fastest moves at 50 of 60 µm/s
constexpr double as_fast = 2.9;    // a typical pedestrian is as fast as the swarm
constexpr double aimed_share = 0.2;  // of the radar's contacts

/// Number of worlds per navigator.
struct Counts {
  int recommended;  ///< safe interval and radar
  int baseline;     ///< 0: these do not take part
  int slow;         ///< D-RRT*, whose decisions take longest

  int of(std::string_view navigator) const {
    if (navigator == navigation::HierarchicalParams::type_name) return slow;
    return is_ours(navigator) ? recommended : baseline;
  }
};

/// A course with its numbers of worlds, quick and full.
struct Race {
  Course course;
  Counts quick;
  Counts full;
};

Course generated(std::string name, scenes::AvoidanceOptions options, bool walls) {
  options.walls = walls;
  return {.name = std::move(name),
          .scenario =
              [options](std::uint64_t seed) { return scenes::avoidance_scenario(seed, options); },
          .world = scenes::avoidance_world};
}

/// Worlds with a hardship and with obstacles that do not turn in no time.
Course hard(scenes::Hardship hardship) {
  return {.name = std::string(enum_name(hardship)),
          .passage_gap = scenes::passage_gap(hardship),
          .scenario =
              [hardship](std::uint64_t seed) {
                return scenes::avoidance_scenario(seed, scenes::hardship_options(hardship, seed));
              },
          .world = scenes::avoidance_world};
}

/// Empty if the recording is missing.
std::optional<Course> recorded(std::string name, double slower, const ReproduceOptions& options) {
  const auto file = data_file(options, scenes::street_file({}).string(), name);
  if (!file) return std::nullopt;
  const auto street = std::make_shared<const scenes::Street>(scenes::read_street(*file, slower));
  return Course{
      .name = std::move(name),
      .scenario = [street](std::uint64_t seed) { return scenes::street_scenario(*street, seed); },
      .world = scenes::avoidance_world};
}

/// The course with noisy and missed detections of obstacles.
Race noisy(Race race) {
  race.course.name += ", noisy";
  race.course.scenario = [exact = race.course.scenario](std::uint64_t seed) {
    experiment::Scenario scenario = exact(seed);
    scenes::see_obstacles_with_noise(scenario);
    return scenario;
  };
  return race;
}

CourseResult crossed(const Race& race, const ReproduceOptions& options, CrossingStore* store,
                     const Stop& stop) {
  const Course& course = race.course;
  const Counts& counts = options.quick ? race.quick : race.full;
  CourseResult out{.course = course, .who = contestants(course.scenario(0)), .crossings = {}};
  std::vector<int> worlds;
  std::erase_if(out.who, [&](const Contestant& who) { return counts.of(who.name) == 0; });
  for (const Contestant& who : out.who) worlds.push_back(counts.of(who.name));
  const Progress bar(options.progress, course.name);
  const auto progress = [&](double share) { bar.update(share); };
  out.crossings = cross(course, out.who, worlds, store, progress, stop);
  if (options.quick) out.extent = "quick";
  if (stop()) out.extent = "interrupted";
  return out;
}

void add_rows(const std::string& figure, const CourseResult& result,
              const ReproduceOptions& options, std::vector<report::ReproduceRow>& rows) {
  for (std::size_t k = 0; k < result.who.size(); ++k) {
    const Tally tally = count_tally(result.crossings[k]);
    if (tally.runs == 0) continue;  // interrupted
    const std::string note = tally.runs == 1 ? "1 world" : fmt::format("{} worlds", tally.runs);
    const auto row = [&](const char* what, const char* unit, std::optional<double> ours,
                         std::optional<double> aim = {}, std::optional<int> share = {},
                         bool at_most = true) {
      report::ReproduceRow out = noted(
          make_row(figure, fmt::format("{}, {}: {}", result.course.name, result.who[k].name, what),
                   unit, {}, ours, aim, at_most),
          note);
      if (share)
        out = noted(std::move(out),
                    fmt::format("95 %: {}", percent_between(share_interval(*share, tally.runs))));
      rows.push_back(aim ? unjudged_if_quick(noted(std::move(out), "the aim is ours"), options)
                         : std::move(out));
    };
    const bool has_aim = figure == "safety" || figure == "hardships";
    row("contacts a run", "1", tally.contacts);
    row("avoidable contacts a run", "1", tally.avoidable,
        has_aim && is_ours(result.who[k].name) ? std::optional(0.0) : std::nullopt);
    row("worlds with an avoidable contact", "%", 100.0 * tally.runs_avoidable / tally.runs, {},
        tally.runs_avoidable);
    // A navigator that always waits touches nothing.
    row("arrived", "%", 100 * tally.arrived,
        figure == "hardships" ? std::optional(99.0) : std::nullopt, tally.runs_arrived, false);
    row("time ÷ straight at full speed, median", "1", tally.slowness);
    if (figure == "hardships") continue;
    row("avoidance cost δ, mean", "1", tally.delta);
    row("turning, median", "°", tally.turning);
  }
}

/// Ratio of contacts of two navigators over the worlds that both have run.
std::optional<double> contact_ratio(const CourseResult& result, std::string_view ours,
                                    std::string_view other) {
  const auto find = [&](std::string_view name) -> const std::vector<Crossing>* {
    for (std::size_t k = 0; k < result.who.size(); ++k)
      if (result.who[k].name == name) return &result.crossings[k];
    return nullptr;
  };
  const auto* a = find(ours);
  const auto* b = find(other);
  if (!a || !b) return std::nullopt;
  std::vector<Crossing> mine, theirs;
  for (std::size_t seed = 0; seed < std::min(a->size(), b->size()); ++seed) {
    if (!(*a)[seed].ran || !(*b)[seed].ran) continue;
    mine.push_back((*a)[seed]);
    theirs.push_back((*b)[seed]);
  }
  const double of_theirs = count_tally(theirs).contacts;
  if (of_theirs <= 0) return std::nullopt;
  return count_tally(mine).contacts / of_theirs;
}

void add_ratios(const std::string& figure, const CourseResult& result,
                const ReproduceOptions& options, std::vector<report::ReproduceRow>& rows) {
  for (const char* other : {"radar", "radar_as_published", "hierarchical_drrt_star"}) {
    const auto ratio = contact_ratio(result, "safe_interval", other);
    if (!ratio) continue;
    const bool is_aim = other == std::string_view("radar");
    report::ReproduceRow row = make_row(
        figure,
        fmt::format("{}: contacts of safe_interval ÷ those of {}", result.course.name, other), "1",
        {}, *ratio, is_aim ? std::optional(aimed_share) : std::nullopt);
    rows.push_back(is_aim ? unjudged_if_quick(noted(std::move(row), "the aim is ours"), options)
                          : std::move(row));
  }
}

std::vector<report::ReproduceRow> raced(const std::string& figure, const std::vector<Race>& races,
                                        const ReproduceOptions& options, const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  std::vector<CourseResult> results;
  std::optional<CrossingStore> store;
  if (!options.out.empty()) {
    make_folder(options.out);
    store.emplace(std::filesystem::path(options.out) / (figure + "-crossings.sqlite"));
  }
  for (const Race& race : races) {
    if (stop()) break;
    results.push_back(crossed(race, options, store ? &*store : nullptr, stop));
    add_rows(figure, results.back(), options, rows);
    if (figure == "fast") add_ratios(figure, results.back(), options, rows);
  }
  if (!store) return rows;
  write_safety(results, options.out, figure);
  if (!options.note) return rows;
  if (store->found() > 0)
    options.note(fmt::format("{} crossings were read from {} and not run again", store->found(),
                             store->name()));
  if (store->outdated() > 0)
    options.note(
        fmt::format("{} crossings in {} were of another build or other worlds and were "
                    "run again",
                    store->outdated(), store->name()));
  if (stop()) options.note("interrupted: the same command resumes it");
  return rows;
}

std::vector<Race> slow_races(const ReproduceOptions& options) {
  std::vector<Race> races{
      {generated("open", scenes::slow_obstacles, false), {5, 3, 2}, {10'000, 500, 100}},
      {generated("walls", scenes::slow_obstacles, true), {3, 2, 1}, {10'000, 500, 40}}};
  if (auto street = recorded("walkers", just_slower, options))
    races.push_back({*street, {6, 6, 6}, {300, 300, 300}});
  return races;
}

}  // namespace

std::vector<report::ReproduceRow> radar_safety(const ReproduceOptions& options, const Stop& stop) {
  return raced("safety", slow_races(options), options, stop);
}

std::vector<report::ReproduceRow> radar_safety_noisy(const ReproduceOptions& options,
                                                     const Stop& stop) {
  std::vector<Race> races;
  for (Race& race : slow_races(options)) races.push_back(noisy(std::move(race)));
  return raced("safety-noisy", races, options, stop);
}

std::vector<report::ReproduceRow> radar_hardships(const ReproduceOptions& options,
                                                  const Stop& stop) {
  std::vector<Race> races;
  for (const auto& [hardship, name] : enum_names(scenes::Hardship()))
    if (hardship != scenes::Hardship::none)
      races.push_back({hard(hardship), {2, 0, 1}, {1250, 0, 100}});
  return raced("hardships", races, options, stop);
}

std::vector<report::ReproduceRow> radar_fast(const ReproduceOptions& options, const Stop& stop) {
  std::vector<Race> races{
      {generated("fast", scenes::fast_obstacles, false), {6, 4, 4}, {1000, 1000, 1000}}};
  if (auto street = recorded("fast walkers", as_fast, options))
    races.push_back({*street, {6, 6, 6}, {300, 300, 300}});
  return raced("fast", races, options, stop);
}

}  // namespace microswarm::reproduce
