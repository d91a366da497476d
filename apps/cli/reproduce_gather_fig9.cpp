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

#include "microswarm/core/file.hpp"
#include "microswarm/core/parallel.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/navigation/rollout.hpp"
#include "microswarm/report/page.hpp"
#include "reproduce_gather.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

// Fig 9: three maps, n = 2 … 1024 robots, the paper's three methods and ours.

constexpr std::size_t populations = 10;
constexpr int population(std::size_t k) { return 2 << k; }
constexpr std::size_t of_64 = 5;
constexpr std::size_t of_1024 = 9;
constexpr std::size_t first_compared = 2;  // n = 8, from which on DCA+OWRRT is best in the paper

struct GatherMethod {
  const char* name;
  Aggregation aggregation;
  bool weighted;
};
constexpr std::array<GatherMethod, 4> gather_methods{
    {{"DCA+OWRRT", Aggregation::divide_and_conquer, true},
     {"HRA+OWRRT", Aggregation::heuristic, true},
     {"HRA+RRT", Aggregation::heuristic, false},
     {"rollout", Aggregation::rollout, true}}};
constexpr std::size_t published_methods = 3;
constexpr std::size_t of_rollout = 3;

struct Ground {
  const char* name;
  scenes::Vascular scene;
  /// Mean steps for n = 64 and 1024, one pair a method.
  std::array<std::array<std::optional<double>, 2>, published_methods> published;
  double work;  ///< that the rollout planner may spend for n = 1024, in robot-steps
};

std::array<Ground, 3> grounds() {
  return {
      {{"T-junction", scenes::t_junction(), {{{{287, 290}}, {{597, 674}}, {{779, 1342}}}}, 40e6},
       {"100 × 90",
        scenes::vascular_network(),
        {{{{767, 910}}, {{1243, 1659}}, {{1977, 3709}}}},
        20e6},
       {"400 × 314",
        scenes::larger_vascular_network(),
        {{{{4188, 5861}}, {{6204, 11598}}, {{9134, std::nullopt}}}},
        40e6}}};
}

/// The rollout planner's work grows with log n: few robots need little.
AggregationParams parameters(const Ground& ground, std::size_t method, std::size_t population) {
  AggregationParams params = gather_params(ground.scene, gather_methods[method].aggregation);
  params.obstacle_weighted = gather_methods[method].weighted;
  params.rollout.most_work =
      ground.work * static_cast<double>(population + 1) / static_cast<double>(populations);
  return params;
}

struct Trial {
  bool ran = false;
  GatherResult result;
};

/// Trials of one map, by method, population and number.
class Trials {
 public:
  explicit Trials(int count)
      : count_(static_cast<std::size_t>(count)),
        all_(gather_methods.size() * populations * count_) {}

  std::size_t size() const { return all_.size(); }
  std::size_t count() const { return count_; }
  Trial& operator[](std::size_t i) { return all_[i]; }
  std::size_t method_of(std::size_t i) const { return i / count_ % gather_methods.size(); }
  /// The largest first: they take the longest.
  std::size_t population_of(std::size_t i) const {
    return populations - 1 - i / (count_ * gather_methods.size());
  }
  std::size_t number_of(std::size_t i) const { return i % count_; }

  std::vector<double> steps(std::size_t method, std::size_t population) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < size(); ++i) {
      if (all_[i].ran && method_of(i) == method && population_of(i) == population)
        out.push_back(all_[i].result.steps);
    }
    return out;
  }
  double mean_steps(std::size_t method, std::size_t population) const {
    const std::vector<double> all = steps(method, population);
    const double sum = std::accumulate(all.begin(), all.end(), 0.0);
    return sum / std::max(1.0, static_cast<double>(all.size()));
  }
  /// How many of a method's trials `is` true for.
  template <class Is>
  double share(std::size_t method, Is&& is) const {
    double yes = 0;
    double ran = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (method_of(i) != method || !all_[i].ran) continue;
      ran += 1;
      yes += is(all_[i]);
    }
    return yes / std::max(1.0, ran);
  }

 private:
  std::size_t count_;
  std::vector<Trial> all_;
};

GatherResult gathered(const AggregationMap& map, const RobotStepper& stepper,
                      const AggregationParams& params, Robots& robots, const Stop& stop) {
  if (params.method == Aggregation::rollout) {
    RolloutGatherer gatherer(map, stepper, params, Rng(1, Purpose::planner));
    return gather(stepper, gatherer, robots, gather_most_steps, stop);
  }
  Gatherer gatherer(map, params);
  return gather(stepper, gatherer, robots, gather_most_steps, stop);
}

Trials gather_on(const Ground& ground, int count, ProgressBar& bar, const Stop& stop) {
  const AggregationMap map = gather_map(ground.scene);
  const RobotStepper stepper(map.map, 1);
  Trials trials(count);
  std::atomic<std::size_t> done = 0;
  std::mutex bar_mutex;
  for_each_index(trials.size(), 0, [&](std::size_t i) {
    if (stop()) return;
    const std::size_t k = trials.population_of(i);
    Robots robots = gather_robots(ground.scene, map.map, stepper, population(k),
                                  static_cast<std::uint32_t>(trials.number_of(i)));
    Trial& trial = trials[i];
    trial.result = gathered(map, stepper, parameters(ground, trials.method_of(i), k), robots, stop);
    trial.ran = trial.result.status != Status::stopped;
    ++done;
    const std::lock_guard lock(bar_mutex);
    bar.update(static_cast<double>(done) / static_cast<double>(trials.size()));
  });
  return trials;
}

std::optional<double> published(const Ground& ground, std::size_t method, std::size_t population) {
  if (method >= published_methods) return {};
  if (population == of_64) return ground.published[method][0];
  if (population == of_1024) return ground.published[method][1];
  return {};
}

void add_means(const Ground& ground, const Trials& trials, std::vector<ReproduceRow>& rows) {
  for (std::size_t m = 0; m < gather_methods.size(); ++m) {
    for (std::size_t k = 0; k < populations; ++k) {
      rows.push_back({.figure = "fig9",
                      .quantity = fmt::format("{}, {}, n = {}: mean steps", ground.name,
                                              gather_methods[m].name, population(k)),
                      .unit = "1",
                      .paper = published(ground, m, k),
                      .ours = trials.mean_steps(m, k)});
    }
    rows.push_back(
        {.figure = "fig9",
         .quantity = fmt::format("{}, {}: gathered", ground.name, gather_methods[m].name),
         .unit = "%",
         .ours = 100 *
                 trials.share(m, [](const Trial& t) { return t.result.status == Status::solved; }),
         .aim = 100,
         .at_most = false});
    rows.push_back(
        {.figure = "fig9",
         .quantity =
             fmt::format("{}, {}: with a livelock broken", ground.name, gather_methods[m].name),
         .unit = "%",
         .ours = 100 * trials.share(m, [](const Trial& t) { return t.result.guard_count > 0; })});
  }
}

/// The T-junction is the published map: there our means should be the paper's.
void add_likeness(const Ground& ground, const Trials& trials, std::vector<ReproduceRow>& rows) {
  for (std::size_t m = 0; m < 2; ++m) {
    for (const std::size_t k : {of_64, of_1024}) {
      const double paper = *published(ground, m, k);
      rows.push_back({.figure = "fig9",
                      .quantity = fmt::format("{}, {}, n = {}: off the published mean", ground.name,
                                              gather_methods[m].name, population(k)),
                      .unit = "%",
                      .ours = 100 * std::abs(trials.mean_steps(m, k) / paper - 1),
                      .aim = 15});
    }
  }
}

/// The larger maps are ours: there the order of the methods and the growth should be the paper's.
void add_order(const Ground& ground, const Trials& trials, std::vector<ReproduceRow>& rows) {
  for (std::size_t k = first_compared; k < populations; ++k) {
    const double others = std::min(trials.mean_steps(1, k), trials.mean_steps(2, k));
    rows.push_back({.figure = "fig9",
                    .quantity = fmt::format("{}, n = {}: DCA+OWRRT's steps ÷ the next best's",
                                            ground.name, population(k)),
                    .unit = "1",
                    .ours = trials.mean_steps(0, k) / std::max(1.0, others),
                    .aim = 1});
  }
  const double paper = *ground.published[0][1] / *ground.published[0][0];
  rows.push_back(
      {.figure = "fig9",
       .quantity = fmt::format("{}, DCA+OWRRT: growth, n = 64 to 1024", ground.name),
       .unit = "1",
       .paper = paper,
       .ours = trials.mean_steps(0, of_1024) / std::max(1.0, trials.mean_steps(0, of_64)),
       .aim = paper});
}

/// What the rollout planner is for.
void add_rollout(const Ground& ground, const Trials& trials, std::optional<double> aim,
                 std::vector<ReproduceRow>& rows) {
  const double steps = trials.mean_steps(of_rollout, of_1024);
  if (aim)
    rows.push_back({.figure = "fig9",
                    .quantity = fmt::format("{}, rollout, n = 1024: steps", ground.name),
                    .unit = "1",
                    .ours = steps,
                    .aim = aim});
  rows.push_back(
      {.figure = "fig9",
       .quantity = fmt::format("{}, n = 1024: rollout's steps ÷ DCA+OWRRT's", ground.name),
       .unit = "1",
       .ours = steps / std::max(1.0, trials.mean_steps(0, of_1024)),
       .aim = aim ? std::nullopt : std::optional(0.7)});
}

/// Processor time so far [s]: others may use the machine too.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What a run takes: the median of some.
double time_of_a_run(const Ground& ground, const Stop& stop) {
  constexpr std::uint32_t runs = 5;
  const AggregationMap map = gather_map(ground.scene);
  const RobotStepper stepper(map.map, 1);
  std::vector<double> times;
  for (std::uint32_t run = 0; run < runs; ++run) {
    Robots robots = gather_robots(ground.scene, map.map, stepper, population(of_1024), run);
    const double began = processor_time();
    gathered(map, stepper, parameters(ground, 0, of_1024), robots, stop);
    times.push_back(processor_time() - began);
  }
  return median(times);
}

/// The longest time that the rollout planner takes for a move.
double longest_decision(const Ground& ground, const Stop& stop) {
  const AggregationMap map = gather_map(ground.scene);
  const RobotStepper stepper(map.map, 1);
  Robots robots = gather_robots(ground.scene, map.map, stepper, population(of_1024), 0);
  RolloutGatherer gatherer(map, stepper, parameters(ground, of_rollout, of_1024),
                           Rng(1, Purpose::planner));
  double longest = 0;
  for (int i = 0; i < gather_most_steps && !stop(); ++i) {
    const double began = processor_time();
    const std::optional<Vec2> move = gatherer.next(robots, stop);
    longest = std::max(longest, processor_time() - began);
    if (!move) break;
    stepper.step(robots, *move, ContactRule::stop);
  }
  return longest;
}

std::string trials_csv(const std::array<Ground, 3>& maps, std::vector<Trials>& trials) {
  std::string out = "map,method,robots,trial,status,steps,mean_way_um,guard_count\n";
  for (std::size_t g = 0; g < trials.size(); ++g) {
    for (std::size_t i = 0; i < trials[g].size(); ++i) {
      const Trial& t = trials[g][i];
      if (!t.ran) continue;
      out += fmt::format("{},{},{},{},{},{},{:.9g},{}\n", maps[g].scene.name,
                         gather_methods[trials[g].method_of(i)].name,
                         population(trials[g].population_of(i)), trials[g].number_of(i),
                         to_string(t.result.status), t.result.steps, t.result.mean_way,
                         t.result.guard_count);
    }
  }
  return out;
}

/// The outline of a violin around x: as wide as values are frequent, by a Gaussian kernel.
void add_violin(std::vector<double> values, double x, double half_width, Series& series) {
  constexpr int levels = 24;
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const double lo = values.front();
  const double hi = values.back();
  const double kernel = std::max(0.5, 0.2 * (hi - lo));
  std::vector<double> density;
  for (int k = 0; k <= levels; ++k) {
    double sum = 0;
    for (const double v : values)
      sum += std::exp(-0.5 * std::pow((v - (lo + (hi - lo) * k / levels)) / kernel, 2));
    density.push_back(sum);
  }
  const double most = *std::max_element(density.begin(), density.end());
  const auto put = [&](int k, double side) {
    series.x.push_back(x + side * half_width * density[static_cast<std::size_t>(k)] / most);
    series.y.push_back(lo + (hi - lo) * k / levels);
  };
  for (int k = 0; k <= levels; ++k) put(k, -1);
  for (int k = levels; k >= 0; --k) put(k, 1);
  put(0, -1);
  series.x.push_back(x);
  series.y.push_back(std::nan(""));  // the pen is lifted
}

Plot plot_of(const Ground& ground, const Trials& trials) {
  Plot plot{.title = ground.name, .x_label = "log_2 n", .y_label = "steps", .y_min = 0};
  Series paper{.label = "published means", .style = PlotStyle::points};
  for (std::size_t m = 0; m < gather_methods.size(); ++m) {
    Series series{.label = gather_methods[m].name};
    std::vector<double> xs;
    for (std::size_t k = 0; k < populations; ++k) {
      const double n = static_cast<double>(k + 1);
      xs.push_back(n + 0.2 * (static_cast<double>(m) - 1.5));
      add_violin(trials.steps(m, k), xs.back(), 0.09, series);
      if (const auto steps = published(ground, m, k)) {
        paper.x.push_back(xs.back());
        paper.y.push_back(*steps);
      }
    }
    for (std::size_t k = 0; k < populations; ++k) {
      series.x.push_back(xs[k]);
      series.y.push_back(trials.mean_steps(m, k));
    }
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(std::move(paper));
  double most = 0;
  for (const Series& series : plot.series)
    for (const double y : series.y) most = std::isnan(y) ? most : std::max(most, y);
  plot.y_max = 1.5 * most;  // the legend stands above
  return plot;
}

/// Mean steps of every method, a line a population.
std::vector<std::vector<std::string>> table_of(const Ground& ground, const Trials& trials) {
  std::vector<std::vector<std::string>> lines{{"n"}};
  for (const GatherMethod& method : gather_methods) lines[0].emplace_back(method.name);
  for (std::size_t k = 0; k < populations; ++k) {
    std::vector<std::string>& line = lines.emplace_back();
    line.push_back(std::to_string(population(k)));
    for (std::size_t m = 0; m < gather_methods.size(); ++m) {
      line.push_back(fmt::format("{:.0f}", trials.mean_steps(m, k)));
      if (const auto steps = published(ground, m, k)) line.back() += fmt::format(" ({})", *steps);
    }
  }
  return lines;
}

void write_figure(const std::array<Ground, 3>& maps, std::vector<Trials>& trials,
                  const fs::path& out) {
  std::vector<Plot> plots;
  std::vector<PageSection> sections{
      {"",
       fmt::format("Steps until n robots are gathered, {} trials each: violins, and lines through "
                   "the means. In brackets and as points what the paper gives.",
                   trials[0].count()),
       {},
       {{"fig9.svg", "DCA, HRA and the rollout planner"}}}};
  for (std::size_t g = 0; g < maps.size(); ++g) {
    plots.push_back(plot_of(maps[g], trials[g]));
    sections.push_back({maps[g].name, "Mean steps.", table_of(maps[g], trials[g]), {}});
  }
  write_file_atomically(out / "fig9-trials.csv", trials_csv(maps, trials));
  write_everywhere(plots, out / "fig9");
  write_page(out / "fig9.html", "Fig 9 of [gather]", sections);
}

}  // namespace

void gather_fig9(const ReproduceOptions& options, const Stop& stop,
                 std::vector<ReproduceRow>& rows) {
  constexpr int full_trials = 30;
  constexpr int quick_trials = 4;
  const std::array<Ground, 3> maps = grounds();
  std::vector<Trials> trials;
  for (std::size_t g = 0; g < maps.size(); ++g) {
    ProgressBar bar(maps[g].name);
    trials.push_back(gather_on(maps[g], options.quick ? quick_trials : full_trials, bar, stop));
    add_means(maps[g], trials[g], rows);
    if (g == 0) {
      add_likeness(maps[g], trials[g], rows);
      add_rollout(maps[g], trials[g], 200, rows);
    } else {
      add_order(maps[g], trials[g], rows);
      add_rollout(maps[g], trials[g], std::nullopt, rows);
    }
  }
  rows.push_back({.figure = "fig9",
                  .quantity = "400 × 314, DCA+OWRRT, n = 1024: processor time of a run",
                  .unit = "s",
                  .ours = time_of_a_run(maps[2], stop),
                  .aim = 0.2});
  rows.push_back(
      {.figure = "fig9",
       .quantity = "400 × 314, rollout, n = 1024: processor time of the longest decision",
       .unit = "s",
       .ours = longest_decision(maps[2], stop),
       .aim = 0.2});
  if (!options.out.empty() && !stop()) write_figure(maps, trials, options.out);
}

}  // namespace microswarm::cli
