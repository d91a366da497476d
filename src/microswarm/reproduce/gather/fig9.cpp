// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <numeric>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/reproduce/gather/fig9.hpp"
#include "microswarm/reproduce/gather/gather.hpp"
#include "microswarm/reproduce/gather/violin.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

// Fig 9: three maps, n = 2 … 1024 robots, the paper's three methods and ours.

/// Parameters of a method. The rollout planner's budget grows with log n, since few robots need
/// little.
navigation::AggregationParams parameters(const Ground& ground, std::size_t method,
                                         std::size_t population, bool quick) {
  navigation::AggregationParams params =
      gather_params(ground.scene, gather_methods[method].aggregation);
  params.obstacle_weighted = gather_methods[method].weighted;
  params.rollout.max_work = (quick ? 0.1 : 1) * ground.work * static_cast<double>(population + 1) /
                            static_cast<double>(populations);
  if (method == of_dca) {
    params.reading = navigation::DcaReading::published;
    params.followed_regions = ground.followed_regions;
    params.last_regions = ground.last_regions;
    params.team_depth = 5;
  }
  return params;
}

struct Trial {
  bool ran = false;
  navigation::GatherResult result;
};

/// Trials on one map, by method, population and trial number.
class Trials {
 public:
  Trials(int count, bool quick)
      : count_(static_cast<std::size_t>(count)),
        quick_(quick),
        all_(gather_methods.size() * populations * count_) {}

  std::size_t size() const { return all_.size(); }
  std::size_t count() const { return count_; }
  Trial& operator[](std::size_t i) { return all_[i]; }
  std::size_t method_at(std::size_t i) const { return i / count_ % gather_methods.size(); }
  /// Largest population first, since it takes the longest.
  std::size_t population_at(std::size_t i) const {
    return populations - 1 - i / (count_ * gather_methods.size());
  }
  std::size_t number_at(std::size_t i) const { return i % count_; }

  std::vector<double> steps(std::size_t method, std::size_t population) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < size(); ++i) {
      if (all_[i].ran && method_at(i) == method && population_at(i) == population)
        out.push_back(all_[i].result.steps);
    }
    return out;
  }
  /// Whether every trial of this method and population has run.
  bool all_ran(std::size_t method, std::size_t population) const {
    return has(population) && steps(method, population).size() == count_;
  }
  double mean_steps(std::size_t method, std::size_t population) const {
    const std::vector<double> all = steps(method, population);
    const double sum = std::accumulate(all.begin(), all.end(), 0.0);
    return sum / std::max(1.0, static_cast<double>(all.size()));
  }
  /// Fraction of a method's trials for which `is` is true.
  template <class Is>
  double share(std::size_t method, Is&& is) const {
    double yes = 0;
    double ran = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (method_at(i) != method || !all_[i].ran) continue;
      ran += 1;
      yes += is(all_[i]);
    }
    return yes / std::max(1.0, ran);
  }

  bool quick() const { return quick_; }
  /// Whether there are trials of this population.
  bool has(std::size_t population) const {
    return !quick_ || population == of_8 || population == of_64 || population == of_1024;
  }
  double spread(std::size_t method, std::size_t population) const {
    return standard_deviation(steps(method, population));
  }

 private:
  std::size_t count_;
  bool quick_;
  std::vector<Trial> all_;
};

navigation::GatherResult gathered(const navigation::AggregationMap& map,
                                  const RobotStepper& stepper,
                                  const navigation::AggregationParams& params, Robots& robots,
                                  const Stop& stop) {
  if (params.method == navigation::Aggregation::rollout) {
    navigation::RolloutPolicy policy(map, stepper, params, Rng(1, Purpose::planner));
    return navigation::gather(stepper, policy, robots, gather_most_steps, stop);
  }
  navigation::AggregationPolicy policy(map, params);
  return navigation::gather(stepper, policy, robots, gather_most_steps, stop);
}

Trials gather_on(const Ground& ground, int count, bool quick, const Progress& bar,
                 const Stop& stop) {
  const navigation::AggregationMap weighted = gather_map(ground.scene, true);
  const navigation::AggregationMap plain = gather_map(ground.scene, false);
  const RobotStepper stepper(weighted.map, 1);
  Trials trials(count, quick);
  std::atomic<std::size_t> done = 0;
  std::mutex bar_mutex;
  for_each_index(trials.size(), 0, [&](std::size_t i) {
    const std::size_t k = trials.population_at(i);
    if (stop() || !trials.has(k)) return;
    const std::size_t m = trials.method_at(i);
    Robots robots =
        gather_robots(ground.scene, weighted, stepper, population(k),
                      static_cast<std::uint32_t>(trials.number_at(i)), ground.min_length);
    Trial& trial = trials[i];
    trial.result = gathered(gather_methods[m].weighted ? weighted : plain, stepper,
                            parameters(ground, m, k, quick), robots, stop);
    trial.ran = trial.result.status != Status::stopped;
    ++done;
    const std::lock_guard lock(bar_mutex);
    bar.update(static_cast<double>(done) / static_cast<double>(trials.size()));
  });
  return trials;
}

std::optional<double> published(const Ground& ground, std::size_t method, std::size_t population) {
  return method < published_methods ? ground.published[method][population] : std::nullopt;
}

/// Means of the methods as published, to match the paper within `tolerance`.
void add_means(const Ground& ground, const Trials& trials,
               std::vector<report::ReproduceRow>& rows) {
  constexpr double tolerance = 0.15;
  for (std::size_t m = 0; m < gather_methods.size(); ++m) {
    for (std::size_t k = 0; k < populations; ++k) {
      if (!trials.all_ran(m, k)) continue;
      const std::string what = fmt::format("{}, {}, n = {}: mean steps", ground.name,
                                           gather_methods[m].name, population(k));
      const double steps = trials.mean_steps(m, k);
      const auto paper = published(ground, m, k);
      if (m >= published_methods || !paper) {
        rows.push_back(row_without_aim("not in the paper", "fig9", what, "1", {}, steps));
      } else if (m == of_plain) {
        rows.push_back(row_without_aim("there every edge, 1.2 long, takes two steps", "fig9", what,
                                       "1", paper, steps));
      } else {
        report::ReproduceRow row = row_within(tolerance, "fig9", what, "1", paper, steps);
        rows.push_back(trials.quick() ? unjudged(std::move(row), "too few trials") : row);
      }
    }
    if (!trials.all_ran(m, of_8)) continue;  // population of the last trials
    const auto add_share = [&](const char* what, const char* why, auto&& is,
                               std::optional<double> aim) {
      rows.push_back(noted(
          make_row("fig9", fmt::format("{}, {}: {}", ground.name, gather_methods[m].name, what),
                   "%", {}, 100 * trials.share(m, is), aim, false),
          why));
    };
    add_share(
        "gathered", "aim is ours", [](const Trial& t) { return t.result.status == Status::solved; },
        100);
    add_share(
        "with a livelock broken", "not in the paper",
        [](const Trial& t) { return t.result.guard_count > 0; }, std::nullopt);
  }
}

/// From n = 8 on DCA+OWRRT is the best of the paper's methods and grows the slowest.
void add_order(const Ground& ground, const Trials& trials,
               std::vector<report::ReproduceRow>& rows) {
  for (const std::size_t m : {of_dca, of_ours}) {
    const char* name = gather_methods[m].name;
    for (std::size_t k = of_8; k < populations; ++k) {
      if (!trials.all_ran(m, k) || !trials.all_ran(of_hra, k) || !trials.all_ran(of_plain, k))
        continue;
      const double others = std::min(trials.mean_steps(of_hra, k), trials.mean_steps(of_plain, k));
      std::optional<double> paper;
      if (const auto plain = published(ground, of_plain, k); m == of_dca)
        paper = *published(ground, of_dca, k) /
                std::min(*published(ground, of_hra, k), plain.value_or(1e9));
      report::ReproduceRow row =
          noted(make_row("fig9",
                         fmt::format("{}, n = {}: {}'s steps ÷ the best HRA's", ground.name,
                                     population(k), name),
                         "1", paper, trials.mean_steps(m, k) / std::max(1.0, others), 1),
                "the paper: DCA is the best");
      rows.push_back(trials.quick() ? unjudged(std::move(row), "too few trials") : row);
    }
    if (!trials.all_ran(m, of_64) || !trials.all_ran(m, of_1024)) continue;
    const double paper = *ground.published[of_dca][of_1024] / *ground.published[of_dca][of_64];
    const double ours = trials.mean_steps(m, of_1024) / std::max(1.0, trials.mean_steps(m, of_64));
    report::ReproduceRow row =
        row_at_most(0.15, "fig9", fmt::format("{}, {}: growth, n = 64 to 1024", ground.name, name),
                    "1", paper, ours);
    rows.push_back(trials.quick() ? unjudged(std::move(row), "too few trials") : row);
    for (const std::size_t k : {of_64, of_1024})
      rows.push_back(row_without_aim("the paper: small", "fig9",
                                     fmt::format("{}, {}, n = {}: standard deviation of steps",
                                                 ground.name, name, population(k)),
                                     "1", {}, trials.spread(m, k)));
  }
}

/// Benefit of the rollout planner, which starts from our DCA.
void add_rollout(const Ground& ground, const Trials& trials,
                 std::vector<report::ReproduceRow>& rows) {
  if (!trials.all_ran(of_rollout, of_1024) || !trials.all_ran(of_ours, of_1024)) return;
  const double share =
      trials.mean_steps(of_rollout, of_1024) / std::max(1.0, trials.mean_steps(of_ours, of_1024));
  const std::string what =
      fmt::format("{}, n = 1024: rollout's steps ÷ those of DCA, ours", ground.name);
  rows.push_back(noted(make_row("fig9", what, "1", {}, share, 1), "aim is ours"));
}

/// Processor time so far [s]; wall-clock time would include other processes.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Median duration of a run.
double time_of_a_run(const Ground& ground, const Stop& stop) {
  constexpr std::uint32_t runs = 5;
  const navigation::AggregationMap map = gather_map(ground.scene, true);
  const RobotStepper stepper(map.map, 1);
  std::vector<double> times;
  for (std::uint32_t run = 0; run < runs; ++run) {
    Robots robots = gather_robots(ground.scene, map, stepper, population(of_1024), run, 0);
    const double began = processor_time();
    gathered(map, stepper, parameters(ground, of_ours, of_1024, false), robots, stop);
    times.push_back(processor_time() - began);
  }
  return median(times);
}

/// Maximum time of the rollout planner for one move.
double longest_decision(const Ground& ground, const Stop& stop) {
  const navigation::AggregationMap map = gather_map(ground.scene, true);
  const RobotStepper stepper(map.map, 1);
  Robots robots = gather_robots(ground.scene, map, stepper, population(of_1024), 0, 0);
  navigation::RolloutPolicy policy(map, stepper, parameters(ground, of_rollout, of_1024, false),
                                   Rng(1, Purpose::planner));
  double longest = 0;
  for (int i = 0; i < gather_most_steps && !stop(); ++i) {
    const double began = processor_time();
    const std::optional<Vec2> move = policy.next(robots, stop);
    longest = std::max(longest, processor_time() - began);
    if (!move) break;
    stepper.step(robots, *move, ContactRule::stop);
  }
  return longest;
}

/// A trial as in trials.csv.
struct TrialRow {
  std::string map;
  std::string method;
  int robots = 0;
  int trial = 0;
  Status status = Status::stopped;
  int steps = 0;
  double mean_distance = 0;
  int guard_count = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.map, plain("map", "Map."));
    visit(self.method, plain("method", "Method."));
    visit(self.robots, plain("robots", "Number of robots."));
    visit(self.trial, plain("trial", "Number of the trial."));
    visit(self.status, plain("status", "How it ended."));
    visit(self.steps, plain("steps", "Number of steps."));
    visit(self.mean_distance, um("mean_way", "Mean distance to the goal at the end."));
    visit(self.guard_count, plain("guard_count", "1 after a livelock."));
  }
};

std::string trials_csv(const std::vector<Ground>& maps, std::vector<Trials>& trials) {
  std::vector<TrialRow> rows;
  for (std::size_t g = 0; g < trials.size(); ++g) {
    for (std::size_t i = 0; i < trials[g].size(); ++i) {
      const Trial& t = trials[g][i];
      if (!t.ran) continue;
      rows.push_back({.map = maps[g].name,
                      .method = std::string(gather_methods[trials[g].method_at(i)].name),
                      .robots = population(trials[g].population_at(i)),
                      .trial = static_cast<int>(trials[g].number_at(i)),
                      .status = t.result.status,
                      .steps = t.result.steps,
                      .mean_distance = t.result.mean_distance,
                      .guard_count = t.result.guard_count});
    }
  }
  return io::csv_table(rows);
}

std::string superscript(std::size_t n) {
  static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                      "⁵", "⁶", "⁷", "⁸", "⁹"};
  return n < 10 ? digits[n] : superscript(n / 10) + digits[n % 10];
}

/// Violins for every n, a line through the means, and the paper's means.
report::Plot draw_plot(const Ground& ground, const Trials& trials) {
  report::Plot plot{.title = ground.name, .x_label = "robots", .y_label = "steps", .y_min = 0};
  plot.key_below = true;
  constexpr double apart = 0.16;
  const auto at = [&](std::size_t m, std::size_t k) {
    return static_cast<double>(k + 1) + apart * (static_cast<double>(m) - 2);
  };
  for (std::size_t m = 0; m < gather_methods.size(); ++m) {
    const GatherMethod& method = gather_methods[m];
    report::Series violins{
        .label = method.name, .style = report::PlotStyle::filled, .colour = method.colour};
    report::Series means{.label = "", .style = report::PlotStyle::line, .colour = method.colour};
    report::Series paper{
        .label = "", .style = report::PlotStyle::published, .colour = method.colour};
    if (m == of_hra) paper.label = "means of the paper";
    for (std::size_t k = 0; k < populations; ++k) {
      if (const auto steps = published(ground, m, k)) {
        paper.x.push_back(at(m, k));
        paper.y.push_back(*steps);
      }
      if (trials.steps(m, k).empty()) continue;
      add_violin(trials.steps(m, k), at(m, k), 0.45 * apart, violins);
      means.x.push_back(at(m, k));
      means.y.push_back(trials.mean_steps(m, k));
    }
    plot.series.push_back(std::move(violins));
    plot.series.push_back(std::move(means));
    if (!paper.x.empty()) plot.series.push_back(std::move(paper));
  }
  for (std::size_t k = 0; k < populations; ++k)
    plot.x_ticks.push_back({"2" + superscript(k + 1), static_cast<double>(k + 1)});
  plot.x_min = 0.5;
  plot.x_max = 10.5;
  return plot;
}

/// Mean steps of every method, one line per population.
std::vector<std::vector<std::string>> to_table(const Ground& ground, const Trials& trials) {
  std::vector<std::vector<std::string>> lines{{"n"}};
  for (const GatherMethod& method : gather_methods) lines[0].emplace_back(method.name);
  for (std::size_t k = 0; k < populations; ++k) {
    std::vector<std::string>& line = lines.emplace_back();
    line.push_back(std::to_string(population(k)));
    if (!trials.has(k)) line.resize(lines[0].size());
    if (!trials.has(k)) continue;
    for (std::size_t m = 0; m < gather_methods.size(); ++m) {
      line.push_back(trials.steps(m, k).empty() ? "–"
                                                : fmt::format("{:.0f}", trials.mean_steps(m, k)));
      if (const auto steps = published(ground, m, k)) line.back() += fmt::format(" ({})", *steps);
    }
  }
  return lines;
}

void write_figure(const std::vector<Ground>& maps, std::vector<Trials>& trials, bool interrupted,
                  const fs::path& out) {
  std::vector<report::Plot> plots;
  std::vector<report::PageSection> sections{
      {"",
       fmt::format("Steps until n robots are gathered, {} trials each: violins, and lines through "
                   "the means. In brackets and as diamonds what the paper gives.{}",
                   trials[0].count(), interrupted ? " Interrupted: not all trials have run." : ""),
       {},
       {{"fig9.svg", "DCA, HRA and the rollout planner"}}}};
  for (std::size_t g = 0; g < trials.size(); ++g) {
    if (g != of_anywhere)  // the same map as the first
      plots.push_back(draw_plot(maps[g], trials[g]));
    sections.push_back({maps[g].name, "Mean steps.", to_table(maps[g], trials[g]), {}});
  }
  write_file_atomically(out / "fig9-trials.csv", trials_csv(maps, trials));
  report::write_plots_everywhere(plots, out / "fig9");
  report::write_page(out / "fig9.html", "Fig 9 of [gather]", sections);
}

}  // namespace

void gather_fig9(const ReproduceOptions& options, const Stop& stop,
                 std::vector<report::ReproduceRow>& rows) {
  constexpr int full_trials = 30;
  constexpr int quick_trials = 2;
  const std::vector<Ground> maps = grounds();
  std::vector<Trials> trials;
  for (const Ground& map : maps) {
    if (stop()) break;
    const Progress bar(options.progress, map.name);
    trials.push_back(
        gather_on(map, options.quick ? quick_trials : full_trials, options.quick, bar, stop));
    add_means(map, trials.back(), rows);
    add_order(map, trials.back(), rows);
    add_rollout(map, trials.back(), rows);
  }
  if (!options.quick && !stop()) {  // quick rows are the same on every machine
    rows.push_back(noted(make_row("fig9", "(c), DCA+OWRRT, ours, n = 1024: processor time of a run",
                                  "s", {}, time_of_a_run(maps.back(), stop), 0.2),
                         "aim is ours"));
    rows.push_back(
        noted(make_row("fig9", "(c), rollout, n = 1024: processor time of the longest decision",
                       "s", {}, longest_decision(maps.back(), stop), 0.2),
              "aim is ours"));
  }
  if (!options.out.empty() && !trials.empty()) write_figure(maps, trials, stop(), options.out);
}

}  // namespace microswarm::reproduce
