// SPDX-License-Identifier: Apache-2.0
// All navigators through the same scenes, beside the earliest arrival of one that knows every
// motion.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/arena/arena_runs.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/scenes/arena/arena.hpp"

namespace microswarm::reproduce {
namespace {

constexpr ArenaExtent every_scene{}, quick_scenes{.seeds = 1, .every = 6};
constexpr double fast_turning = radians(60);  // mean of a run [rad/s]
constexpr double detour = 1.5;                // way over the shortest

/// Counts over the runs of a navigator.
struct ArenaTally {
  int scenes = 0, refused = 0, arrived = 0, contacts = 0, avoidable = 0, waits = 0, turns = 0,
      detours = 0;
  std::vector<double> over_optimum{}, turning{}, step_p50{}, step_p99{};

  double percent(int count) const { return scenes == 0 ? 0 : 100.0 * count / scenes; }
};

ArenaTally count_runs(const std::vector<ArenaScene>& scenes, std::size_t navigator) {
  ArenaTally tally;
  for (const ArenaScene& scene : scenes) {
    if (!scene.done) continue;
    const DrivenRun& run = scene.runs[navigator];
    ++tally.scenes;
    tally.refused += !run.refusal.empty();
    if (!run.ran) continue;
    tally.contacts += run.contacts > 0;
    tally.avoidable += run.avoidable > 0;
    tally.turns += run.turning > fast_turning * run.time;
    tally.step_p50.push_back(run.step_p50);
    tally.step_p99.push_back(run.step_p99);
    if (run.status != Status::solved) {
      tally.waits += scene.optimum && run.contacts == 0;
      continue;
    }
    ++tally.arrived;
    tally.detours += run.length > detour * scene.shortest;
    tally.turning.push_back(degrees(run.turning));
    if (scene.optimum) tally.over_optimum.push_back(run.time / *scene.optimum);
  }
  return tally;
}

std::optional<double> quantile_if_any(const std::vector<double>& values, double q) {
  return values.empty() ? std::nullopt : std::optional(quantile(values, q));
}

/// Rows of a navigator; aims are ours, and the recommended navigator has all of them.
void add_arena_rows(const DrivenNavigator& navigator, const ArenaTally& t,
                    const ReproduceOptions& options, std::vector<report::ReproduceRow>& rows) {
  const auto add = [&](const char* what, const char* unit, std::optional<double> ours,
                       std::optional<double> aim, bool at_most, std::string note = {}) {
    report::ReproduceRow row = make_row("arena", fmt::format("{}: {}", navigator.name, what), unit,
                                        {}, ours, aim, at_most);
    if (aim) note += (note.empty() ? "" : "; ") + std::string("aim is ours");
    rows.push_back(unjudged_if_quick(noted(std::move(row), note), options));
  };
  const auto aim = [&](double value) {
    return navigator.is_recommended ? std::optional(value) : std::nullopt;
  };
  std::optional<double> arrivals = aim(99);
  if (navigator.name == "D-RRT*, ours") arrivals = 97;
  add("arrived", "%", t.percent(t.arrived), arrivals, false, share_text(t.arrived, t.scenes));
  if (t.refused > 0)
    add("refused", "%", t.percent(t.refused), {}, true, "the run would be pointless");
  add("contact", "%", t.percent(t.contacts), aim(0.5), true, share_text(t.contacts, t.scenes));
  add("avoidable contact", "%", t.percent(t.avoidable), aim(0), true,
      share_text(t.avoidable, t.scenes));
  add("held or time limit where one arrives", "%", t.percent(t.waits), aim(0), true);
  add("time over the optimum, median", "", median_if_any(t.over_optimum), aim(1.02), true);
  add("time over the optimum, nine tenths", "", quantile_if_any(t.over_optimum, 0.9), aim(1.15),
      true);
  add("way over 1.5 times the shortest", "%", t.percent(t.detours), {}, true);
  add("turning, median", "°", median_if_any(t.turning), {}, true);
  add("turns by more than 60 °/s", "%", t.percent(t.turns), aim(2), true);
}

/// A run of a navigator through a scene.
struct ArenaRunRow {
  std::string kind;
  std::string group;
  std::uint64_t seed = 0;
  std::string navigator;
  std::string result;
  double time = 0;
  std::optional<double> optimum;
  double length = 0;
  double shortest = 0;
  double turning = 0;
  int contacts = 0;
  int avoidable = 0;
  double step_p50 = 0;
  double step_p99 = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.kind, plain("kind", "Kind of scene."));
    visit(self.group, plain("group", "Group of kinds."));
    visit(self.seed, plain("seed", "Seed of the scene."));
    visit(self.navigator, plain("navigator", "Navigator."));
    visit(self.result, plain("result", "How the run ended, or refused."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.optimum, s("optimum", "Earliest arrival if all motions are known."));
    visit(self.length, um("length", "Length of the path."));
    visit(self.shortest, um("shortest", "Shortest way among the walls alone."));
    visit(self.turning, deg("turning", "Total turning."));
    visit(self.contacts, plain("contacts", "Contacts."));
    visit(self.avoidable, plain("avoidable", "Avoidable contacts."));
    visit(self.step_p50, s("step_p50", "Median time of a decision."));
    visit(self.step_p99, s("step_p99", "99th percentile of a decision's time."));
  }
};

std::string arena_csv(const std::vector<ArenaScene>& scenes,
                      const std::vector<DrivenNavigator>& who) {
  std::vector<ArenaRunRow> rows;
  for (const ArenaScene& scene : scenes) {
    if (!scene.done) continue;
    const scenes::ArenaKind& kind = scenes::arena_kinds()[scene.kind];
    for (std::size_t k = 0; k < who.size(); ++k) {
      const DrivenRun& run = scene.runs[k];
      rows.push_back(
          {.kind = std::string(kind.name),
           .group = std::string(enum_name(kind.group)),
           .seed = scene.seed,
           .navigator = who[k].name,
           .result = run.refusal.empty() ? std::string(enum_name(run.status)) : "refused",
           .time = run.time,
           .optimum = scene.optimum,
           .length = run.length,
           .shortest = scene.shortest,
           .turning = run.turning,
           .contacts = run.contacts,
           .avoidable = run.avoidable,
           .step_p50 = run.step_p50,
           .step_p99 = run.step_p99});
    }
  }
  return io::csv_table(rows);
}

/// Shares of the scenes that are crossed within a multiple of the optimum, and avoidable contacts.
void plot_arena(const std::vector<DrivenNavigator>& who, const std::vector<ArenaTally>& tallies,
                const std::filesystem::path& folder) {
  constexpr double farthest = 4;
  report::Plot shares{.title = "Time over the earliest arrival",
                      .x_label = "time ÷ optimum",
                      .y_label = "scenes crossed (%)"};
  shares.log_x = true;
  shares.x_min = 0.97;
  shares.x_max = farthest;
  shares.y_min = 0;
  shares.y_max = 100;
  for (const double ratio : {1.0, 1.2, 1.5, 2.0, 3.0, farthest})
    shares.x_ticks.push_back({fmt::format("{:g}", ratio), ratio});
  shares.key_below = true;
  report::Plot contacts{.title = "Avoidable contacts", .y_label = "scenes (%), 95 % intervals"};
  contacts.y_min = 0;
  contacts.x_min = 0.5;
  contacts.x_max = static_cast<double>(who.size()) + 0.5;
  for (std::size_t k = 0; k < who.size(); ++k) {
    const ArenaTally& t = tallies[k];
    std::vector<double> ratios = t.over_optimum;
    std::ranges::sort(ratios);
    report::Series steps{.label = who[k].name, .style = report::PlotStyle::line};
    double share = 0;
    for (const double ratio : ratios) {
      steps.x.push_back(ratio), steps.y.push_back(share);
      share += 100.0 / t.scenes;
      steps.x.push_back(ratio), steps.y.push_back(share);
    }
    steps.x.push_back(farthest), steps.y.push_back(share);
    shares.series.push_back(std::move(steps));
    const double x = static_cast<double>(k + 1);
    const ShareInterval interval = share_interval(t.avoidable, t.scenes);
    contacts.series.push_back({.label = "",
                               .x = {x},
                               .y = {t.percent(t.avoidable)},
                               .style = report::PlotStyle::points,
                               .colour = k,
                               .low = {100 * interval.low},
                               .high = {100 * interval.high}});
    contacts.x_ticks.push_back({who[k].name, x});
  }
  report::write_plots_everywhere({shares, contacts}, folder / "arena");
}

std::vector<report::ReproduceRow> all_scenes(const ReproduceOptions& options, const Stop& stop) {
  const std::vector<DrivenNavigator> who = driven_navigators();
  const Progress bar(options.progress, "arena");
  const std::vector<ArenaScene> scenes = run_arena(
      who, options.quick ? quick_scenes : every_scene, [&](double share) { bar.update(share); },
      stop);
  std::vector<report::ReproduceRow> rows;
  std::vector<ArenaTally> tallies;
  for (std::size_t k = 0; k < who.size(); ++k) {
    tallies.push_back(count_runs(scenes, k));
    if (tallies.back().scenes > 0) add_arena_rows(who[k], tallies.back(), options, rows);
  }
  if (!options.out.empty() && !rows.empty()) {
    write_file_atomically(std::filesystem::path(options.out) / "arena-runs.csv",
                          arena_csv(scenes, who));
    plot_arena(who, tallies, options.out);
  }
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> arena_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop) {
  constexpr Figure figures[] = {{"all", all_scenes}};
  return reproduce_figures("arena", figures, figure, options, stop);
}

}  // namespace microswarm::reproduce
