// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/safety_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/reproduce/gather/gather.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr int worlds_written = 3;  // per navigator and course
constexpr std::size_t obstacles_a_bin = 10;
constexpr int enough_worlds = 10;     // per bin; bins with fewer are not joined by a line
constexpr double min_percent = 0.01;  // of extra time; the logarithmic axis has no zero

/// One colour per method in all figures.
std::size_t navigator_colour(std::string_view navigator) {
  using namespace report::method_colours;  // NOLINT(google-build-using-namespace)
  constexpr std::array<std::pair<std::string_view, std::size_t>, 8> colours{
      {{"hierarchical_drrt_star", drrt_star},
       {"radar", report::method_colours::radar},
       {"radar_as_published", radar_as_published},
       {"safe_interval", report::method_colours::safe_interval},
       {"straight_stop", straight_stop},
       {"potential_field", potential_field},
       {"velocity_obstacle", velocity_obstacle},
       {"follow_path", follow_path}}};
  for (const auto& [name, colour] : colours)
    if (name == navigator) return colour;
  return other;
}

double slowness(const Crossing& c) { return c.time / c.straight; }

template <class Visit>
void for_each_run(const std::vector<CourseResult>& results, Visit&& visit) {
  for (const CourseResult& result : results)
    for (std::size_t k = 0; k < result.who.size(); ++k)
      for (std::size_t seed = 0; seed < result.crossings[k].size(); ++seed)
        if (result.crossings[k][seed].ran) visit(result, k, seed, result.crossings[k][seed]);
}

/// A run of a navigator in a world.
struct RunRow {
  std::string course;
  std::string navigator;
  std::uint64_t seed = 0;
  Status status = Status::stopped;
  bool arrived = false;
  int obstacles = 0;
  double time = 0;
  double straight = 0;
  double delta = 0;
  double turning = 0;
  std::optional<double> min_gap;
  double hold = 0;
  std::uint64_t contacts = 0;
  int avoidable = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.course, plain("course", "Course."));
    visit(self.navigator, plain("navigator", "Navigator."));
    visit(self.seed, plain("seed", "Seed of the world."));
    visit(self.status, plain("status", "How the run ended."));
    visit(self.arrived, plain("arrived", "1 if the goal was reached."));
    visit(self.obstacles, plain("obstacles", "Number of obstacles."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.straight, s("straight", "Time of the straight path."));
    visit(self.delta, plain("delta", "Mean avoidance cost."));
    visit(self.turning, deg("turning", "Total turning."));
    visit(self.min_gap, um("least_gap", "Smallest gap."));
    visit(self.hold, s("hold", "Time in hold."));
    visit(self.contacts, plain("contacts", "Contacts."));
    visit(self.avoidable, plain("avoidable", "Avoidable contacts."));
  }
};

/// All runs of a navigator in a course.
struct SummaryRow {
  std::string course;
  std::string navigator;
  int worlds = 0;
  double contacts_a_run = 0;
  double avoidable_a_run = 0;
  int worlds_avoidable = 0;
  int worlds_arrived = 0;
  std::optional<double> slowness_median;
  double delta_mean = 0;
  std::optional<double> turning_median;
  std::string extent;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.course, plain("course", "Course."));
    visit(self.navigator, plain("navigator", "Navigator."));
    visit(self.worlds, plain("worlds", "Number of worlds."));
    visit(self.contacts_a_run, plain("contacts_a_run", "Mean contacts."));
    visit(self.avoidable_a_run, plain("avoidable_a_run", "Mean avoidable contacts."));
    visit(self.worlds_avoidable, plain("worlds_avoidable", "Worlds with an avoidable contact."));
    visit(self.worlds_arrived, plain("worlds_arrived", "Worlds in which the goal was reached."));
    visit(self.slowness_median,
          plain("slowness_median", "Median time over that of the straight path."));
    visit(self.delta_mean, plain("delta_mean", "Mean avoidance cost."));
    visit(self.turning_median, deg("turning_median", "Median turning."));
    visit(self.extent, plain("extent", "Extent of the campaign."));
  }
};

/// A contact in a run.
struct ContactRow {
  std::string course;
  std::string navigator;
  std::uint64_t seed = 0;
  double t = 0;
  std::string kind;
  std::uint32_t body = 0;
  double x = 0;
  double y = 0;
  double speed = 0;
  bool avoidable = false;
  std::optional<double> decided;
  std::string manoeuvre;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.course, plain("course", "Course."));
    visit(self.navigator, plain("navigator", "Navigator."));
    visit(self.seed, plain("seed", "Seed of the world."));
    visit(self.t, s("t", "Time of the contact."));
    visit(self.kind, plain("kind", "wall or obstacle."));
    visit(self.body, plain("body", "Index of the body."));
    visit(self.x, um("x", "Position of the swarm, to the right."));
    visit(self.y, um("y", "Position of the swarm, upwards."));
    visit(self.speed, um_per_s("speed", "Speed of the swarm."));
    visit(self.avoidable, plain("avoidable", "1 if it could have been avoided."));
    visit(self.decided,
          s("decided", "Time before the contact of the last decision that avoids it."));
    visit(self.manoeuvre, plain("way", "Manoeuvre that avoids it."));
  }
};

std::string runs_csv(const std::vector<CourseResult>& results) {
  std::vector<RunRow> rows;
  for_each_run(results,
               [&](const CourseResult& result, std::size_t k, std::size_t seed, const Crossing& c) {
                 rows.push_back({.course = result.course.name,
                                 .navigator = result.who[k].name,
                                 .seed = seed,
                                 .status = c.status,
                                 .arrived = c.arrived,
                                 .obstacles = static_cast<int>(c.obstacles),
                                 .time = c.time,
                                 .straight = c.straight,
                                 .delta = c.delta,
                                 .turning = c.turning,
                                 .min_gap = c.min_gap,
                                 .hold = c.hold_time,
                                 .contacts = c.contacts.size(),
                                 .avoidable = c.avoidable()});
               });
  return io::csv_table(rows);
}

std::string summary_csv(const std::vector<CourseResult>& results) {
  std::vector<SummaryRow> rows;
  for (const CourseResult& result : results)
    for (std::size_t k = 0; k < result.who.size(); ++k) {
      const Tally t = count_tally(result.crossings[k]);
      if (t.runs == 0) continue;
      SummaryRow& row = rows.emplace_back(SummaryRow{.course = result.course.name,
                                                     .navigator = result.who[k].name,
                                                     .worlds = t.runs,
                                                     .contacts_a_run = t.contacts,
                                                     .avoidable_a_run = t.avoidable,
                                                     .worlds_avoidable = t.runs_avoidable,
                                                     .worlds_arrived = t.runs_arrived,
                                                     .slowness_median = t.slowness,
                                                     .delta_mean = t.delta,
                                                     .turning_median = {},
                                                     .extent = result.extent});
      if (t.turning) row.turning_median = radians(*t.turning);
    }
  return io::csv_table(rows);
}

std::string contacts_csv(const std::vector<CourseResult>& results) {
  std::vector<ContactRow> rows;
  for_each_run(
      results, [&](const CourseResult& result, std::size_t k, std::size_t seed, const Crossing& c) {
        for (const experiment::ContactVerdict& v : c.contacts) {
          const experiment::RunEvent& contact = v.contact;
          ContactRow& row = rows.emplace_back(ContactRow{
              .course = result.course.name,
              .navigator = result.who[k].name,
              .seed = seed,
              .t = contact.t,
              .kind = contact.kind == experiment::EventKind::contact_wall ? "wall" : "obstacle",
              .body = contact.body,
              .x = contact.position.x,
              .y = contact.position.y,
              .speed = contact.speed,
              .avoidable = v.avoidable,
              .decided = {},
              .manoeuvre = v.manoeuvre});
          if (v.avoidable) row.decided = v.decided;
        }
      });
  return io::csv_table(rows);
}

void write_worlds(const std::vector<CourseResult>& results, const fs::path& folder) {
  make_folder(folder.string());
  const CourseResult* course = nullptr;
  std::size_t of = 0;
  int written = 0;
  for_each_run(
      results, [&](const CourseResult& result, std::size_t k, std::size_t seed, const Crossing& c) {
        if (course != &result || of != k) course = &result, of = k, written = 0;
        if (c.avoidable() == 0 || written == worlds_written) return;
        ++written;
        experiment::Scenario scenario = result.course.scenario(seed);
        scenario.navigator = result.who[k].params(scenario, result.course.passage_gap);
        std::string stem = fmt::format("{}-{}-{}", result.course.name, result.who[k].name, seed);
        std::erase(stem, ',');
        std::replace(stem.begin(), stem.end(), ' ', '-');
        write_scenario(std::move(scenario), folder, stem);
      });
}

/// Mean contacts per run over the number of obstacles: lines through bins with enough runs, rings
/// otherwise.
report::Plot contacts_plot(const CourseResult& result) {
  report::Plot plot{
      .title = result.course.name,
      .x_label = fmt::format("obstacles (rings: fewer than {} worlds)", enough_worlds),
      .y_label = "contacts a run",
      .key_below = true,
      .y_min = 0};
  std::vector<report::Series> few;
  for (std::size_t k = 0; k < result.who.size(); ++k) {
    std::vector<double> contacts;
    std::vector<int> runs;
    for (const Crossing& c : result.crossings[k]) {
      if (!c.ran) continue;
      const std::size_t bin = c.obstacles / obstacles_a_bin;
      if (runs.size() <= bin) contacts.resize(bin + 1), runs.resize(bin + 1);
      contacts[bin] += static_cast<double>(c.contacts.size());
      ++runs[bin];
    }
    plot.series.push_back({.label = result.who[k].name,
                           .x = {},
                           .y = {},
                           .style = report::PlotStyle::marked,
                           .colour = navigator_colour(result.who[k].name)});
    few.push_back({.label = "", .x = {}, .y = {}, .style = report::PlotStyle::rings});
    for (std::size_t bin = 0; bin < runs.size(); ++bin) {
      if (runs[bin] == 0) continue;
      report::Series& series = runs[bin] < enough_worlds ? few.back() : plot.series.back();
      series.x.push_back(static_cast<double>(obstacles_a_bin) * (static_cast<double>(bin) + 0.5));
      series.y.push_back(contacts[bin] / runs[bin]);
    }
    if (plot.series.back().x.empty()) std::swap(few.back().label, plot.series.back().label);
  }
  double most = 0, longest = 0;
  for (const std::vector<report::Series>* all : {&plot.series, &few})
    for (const report::Series& series : *all) {
      for (const double x : series.x) longest = std::max(longest, x);
      for (const double y : series.y) most = std::max(most, y);
    }
  plot.x_min = 0;
  plot.x_max = longest + 0.5 * static_cast<double>(obstacles_a_bin);
  plot.y_max = std::max(0.1, 1.1 * most);
  for (std::size_t k = 0; k < few.size(); ++k) few[k].colour = plot.series[k].colour;
  std::move(few.begin(), few.end(), std::back_inserter(plot.series));
  return plot;
}

/// One column per navigator, even without data.
void name_columns(const CourseResult& result, report::Plot& plot) {
  plot.x_min = 0.5;
  plot.x_max = static_cast<double>(result.who.size()) + 0.5;
  for (std::size_t k = 0; k < result.who.size(); ++k)
    plot.x_ticks.push_back({result.who[k].name, static_cast<double>(k + 1)});
}

report::Plot times_plot(const CourseResult& result) {
  report::Plot plot{.title = result.course.name, .y_label = "time lost (%)", .log_y = true};
  name_columns(result, plot);
  for (std::size_t k = 0; k < result.who.size(); ++k) {
    report::Series series{.label = result.who[k].name,
                          .x = {},
                          .y = {},
                          .style = report::PlotStyle::box,
                          .colour = navigator_colour(result.who[k].name)};
    for (const Crossing& c : result.crossings[k])
      if (c.ran && c.arrived) series.y.push_back(std::max(min_percent, 100 * (slowness(c) - 1)));
    series.x.assign(series.y.size(), static_cast<double>(k + 1));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Avoidable contacts per run on a logarithmic axis, with a separate position for zero.
report::Plot avoidable_plot(const CourseResult& result) {
  report::Plot plot{
      .title = result.course.name, .y_label = "avoidable contacts a run", .log_y = true};
  name_columns(result, plot);
  double least = 1, most = 1;
  for (const auto& crossings : result.crossings) {
    const double avoidable = count_tally(crossings).avoidable;
    if (avoidable > 0) least = std::min(least, avoidable);
    most = std::max(most, avoidable);
  }
  const int first = static_cast<int>(std::floor(maths::log10(least)));
  const int last = static_cast<int>(std::ceil(maths::log10(most)));
  const double none = maths::pow(10, first - 0.7);  // below the first power
  plot.y_ticks.push_back({"none", none});
  for (int power = first; power <= last; ++power) {
    const double at = maths::power(10, power);
    plot.y_ticks.push_back({fmt::format("{:g}", at), at});
  }
  plot.y_min = 0.5 * none;
  plot.y_max = 2 * maths::power(10, last);
  for (std::size_t k = 0; k < result.who.size(); ++k) {
    const Tally tally = count_tally(result.crossings[k]);
    if (tally.runs == 0) continue;
    const bool some = tally.avoidable > 0;
    plot.series.push_back({.label = "",
                           .x = {static_cast<double>(k + 1)},
                           .y = {some ? tally.avoidable : none},
                           .style = some ? report::PlotStyle::points : report::PlotStyle::rings,
                           .colour = navigator_colour(result.who[k].name)});
  }
  return plot;
}

/// Text such as "98.7 (98.4 … 98.9)".
std::string percent(int some, int all) {
  const ShareInterval interval = share_interval(some, all);
  return fmt::format("{:.3g} ({})", 100.0 * some / std::max(1, all), percent_between(interval));
}

std::vector<std::vector<std::string>> to_table(const CourseResult& result) {
  std::vector<std::vector<std::string>> lines{
      {"navigator", "worlds", "contacts a run", "avoidable a run", "worlds with one, % (95 %)",
       "runs with contact, %", "arrived, % (95 %)", "time ÷ straight, median", "mean δ",
       "turning °, median"}};
  for (std::size_t k = 0; k < result.who.size(); ++k) {
    const Tally t = count_tally(result.crossings[k]);
    lines.push_back({result.who[k].name, std::to_string(t.runs), fmt::format("{:.4f}", t.contacts),
                     fmt::format("{:.4f}", t.avoidable), percent(t.runs_avoidable, t.runs),
                     fmt::format("{:.2f}", 100 * t.touched), percent(t.runs_arrived, t.runs),
                     t.slowness ? fmt::format("{:.3f}", *t.slowness) : "–",
                     fmt::format("{:.3f}", t.delta),
                     t.turning ? fmt::format("{:.0f}", *t.turning) : "–"});
  }
  return lines;
}

}  // namespace

std::string percent_between(const ShareInterval& interval) {
  return fmt::format("{:.3g} … {:.3g}", 100 * interval.low, 100 * interval.high);
}

Tally count_tally(std::span<const Crossing> crossings) {
  Tally out;
  std::vector<double> times, turning;
  for (const Crossing& c : crossings) {
    if (!c.ran) continue;
    turning.push_back(degrees(c.turning));
    ++out.runs;
    out.contacts += static_cast<double>(c.contacts.size());
    out.avoidable += c.avoidable();
    out.touched += !c.contacts.empty();
    out.runs_avoidable += c.avoidable() > 0;
    out.runs_arrived += c.arrived;
    out.arrived += c.arrived;
    out.delta += c.delta;
    if (c.arrived) times.push_back(slowness(c));
  }
  for (double* sum : {&out.contacts, &out.avoidable, &out.touched, &out.arrived, &out.delta})
    *sum /= std::max(1, out.runs);
  out.slowness = median_if_any(times);
  out.turning = median_if_any(turning);
  return out;
}

bool is_ours(std::string_view navigator) {
  constexpr std::array<std::string_view, 3> ours{"hierarchical_drrt_star", "radar",
                                                 "safe_interval"};
  return std::find(ours.begin(), ours.end(), navigator) != ours.end();
}

void write_safety(const std::vector<CourseResult>& results, const fs::path& folder,
                  const std::string& stem) {
  std::vector<report::Plot> contacts;
  std::vector<report::Plot> times;
  std::vector<report::Plot> avoidable;
  std::vector<report::PageSection> sections{
      {"",
       "Contacts by the number of obstacles, and how long the crossing took. A contact counts as "
       "avoidable when holding or retreating could have avoided it. Time lost is that beyond the "
       "straight way at full speed.",
       {},
       {{stem + "-avoidable.svg", "Avoidable contacts a run"},
        {stem + "-contacts.svg", "Contacts a run"},
        {stem + "-times.svg", "Times"}}}};
  for (const CourseResult& result : results) {
    contacts.push_back(contacts_plot(result));
    times.push_back(times_plot(result));
    avoidable.push_back(avoidable_plot(result));
    sections.push_back(
        {result.course.name,
         result.extent == "full" ? "" : fmt::format("Not the whole campaign: {}.", result.extent),
         to_table(result),
         {}});
  }
  write_file_atomically(folder / (stem + ".csv"), summary_csv(results));
  write_file_atomically(folder / (stem + "-runs.csv"), runs_csv(results));
  write_file_atomically(folder / (stem + "-contacts.csv"), contacts_csv(results));
  write_everywhere(contacts, folder / (stem + "-contacts"));
  write_everywhere(avoidable, folder / (stem + "-avoidable"));
  write_everywhere(times, folder / (stem + "-times"));
  report::write_page(folder / (stem + ".html"), "Crossing among obstacles", sections);
  write_worlds(results, folder / (stem + "-worlds"));
}

}  // namespace microswarm::reproduce
