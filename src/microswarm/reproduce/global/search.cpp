// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/planning/global_input/global_shorten.hpp"
#include "microswarm/reproduce/global/global.hpp"
#include "microswarm/scenes/global_worlds.hpp"

namespace microswarm::reproduce {
namespace {

constexpr int max_search_nodes = 1'000'000;  // a minute on one core
constexpr const char* by_the_search = "the search is beyond the paper";

/// Results of searches with several seeds.
struct Searches {
  std::vector<double> seconds, nodes, found, brief, apart;  // of solved searches
  std::vector<double> worst;                                // of unsolved searches

  void add(const scenes::GlobalTask& task, const planning::GlobalSearchParams& params, int seed,
           const ReproduceOptions& options, const std::string& name, const Stop& stop) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = Stop::Clock::now();
    planning::GlobalSearch search =
        planning::global_search(task.map, task.starts, task.goals, params, rng, stop);
    planning::GlobalPlan& plan = search.plan;
    if (stop()) return;
    if (plan.status == Status::solved) {
      seconds.push_back(seconds_since(began));
      nodes.push_back(static_cast<double>(search.counts.samples));
      found.push_back(static_cast<double>(plan.inputs.size()));
      plan = planning::shortened(
          task.map, plan, task.goals,
          {params.robostep, params.contact, params.separation, params.goal_tolerance}, stop);
      brief.push_back(static_cast<double>(plan.inputs.size()));
      apart.push_back(min_distance(plan));
    } else {
      worst.push_back(plan.worst);
    }
    if (seed == 0)
      draw_plan(options, name,
                fmt::format("{}: {} robots, {} inputs", task.name, task.starts.size(),
                            plan.inputs.size()),
                task.map, plan, task.goals, params.goal_tolerance);
  }

  std::vector<report::ReproduceRow> rows(const char* figure, const std::string& who,
                                         const planning::GlobalSearchParams& params) const {
    const auto row = [&](const char* what, const char* unit, std::optional<double> ours) {
      return row_without_aim(by_the_search, figure, who + what, unit, {}, ours);
    };
    const std::size_t tries = found.size() + worst.size();
    const double solved = 100.0 * static_cast<double>(found.size()) / static_cast<double>(tries);
    std::vector<report::ReproduceRow> all{
        noted(row(": solved", "%", solved),
              fmt::format("{} of {} tries of {} nodes", found.size(), tries, params.max_nodes))};
    if (!found.empty()) {
      all.push_back(row(": time, median", "s", median(seconds)));
      all.push_back(row(": time, longest", "s", std::ranges::max(seconds)));
      all.push_back(row(": nodes, median", "1", median(nodes)));
      all.push_back(row(": inputs, median", "1", median(found)));
      all.push_back(row(": inputs when shortened, median", "1", median(brief)));
    }
    if (!worst.empty())
      all.push_back(row(": worst robot's distance where not solved, median", "µm", median(worst)));
    if (params.separation > 0 && !apart.empty())
      all.push_back(row(": least distance between robots", "µm", std::ranges::min(apart)));
    return all;
  }
};

scenes::GlobalTask task_of_env(int env, std::size_t robots) {
  scenes::GlobalTask task{fmt::format("Env {}", env), scenes::global_world(env), {}, {}};
  task.starts.assign(scenes::global_starts.begin(), scenes::global_starts.begin() + robots);
  task.goals.assign(scenes::global_goals.begin(), scenes::global_goals.begin() + robots);
  return task;
}

}  // namespace

std::vector<report::ReproduceRow> search_task(const char* figure, const char* name,
                                              const scenes::GlobalTask& task,
                                              planning::GlobalSearchParams params, int seeds,
                                              const ReproduceOptions& options, const Stop& stop) {
  params.robostep = task.robostep;
  params.goal_tolerance = task.tolerance;
  params.max_nodes = std::min(params.max_nodes, max_search_nodes);
  Searches searches;
  for (int seed = 0; seed < seeds && !stop(); ++seed)
    searches.add(task, params, seed, options, name, stop);
  if (stop()) return {};
  return searches.rows(
      figure,
      fmt::format("search, {}, {} robots, {:g} µm", task.name, task.starts.size(), task.tolerance),
      params);
}

std::vector<report::ReproduceRow> global_digestive(const ReproduceOptions& options,
                                                   const Stop& stop) {
  return search_task("fig8", "fig8", scenes::digestive_task(), {}, options.quick ? 1 : 5, options,
                     stop);
}

// Beyond the paper: two to four robots in Env 1–4.
std::vector<report::ReproduceRow> global_beyond(const ReproduceOptions& options, const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  for (const std::size_t robots : {2U, 3U, 4U}) {
    const int seeds = options.quick ? (robots < 4 ? 3 : 1) : (robots < 4 ? 20 : 5);
    const planning::GlobalSearchParams params{.max_nodes = max_search_nodes};
    Searches searches;
    for (int env = 1; env <= scenes::global_worlds; ++env)
      for (int seed = 0; seed < seeds && !stop(); ++seed)
        searches.add(task_of_env(env, robots), params, seed, options,
                     fmt::format("env{}-n{}", env, robots), stop);
    if (stop()) return rows;
    const auto more =
        searches.rows("beyond", fmt::format("search, Env 1–4, {} robots", robots), params);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

// Beyond the paper, which shows four robots.
std::vector<report::ReproduceRow> global_six(const ReproduceOptions& options, const Stop& stop) {
  scenes::GlobalTask task = scenes::six_robots(1);
  task.name = "Env 1";
  const int seeds = options.quick ? 1 : 3;
  planning::GlobalSearchParams params;
  if (options.quick) params.max_nodes = 100'000;
  auto rows = search_task("beyond", "env1-n6", task, params, seeds, options, stop);
  task.name = "Env 1, goals apart";
  task.goals = scenes::six_goals_apart();
  const auto more = search_task("beyond", "env1-n6-apart", task, params, seeds, options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace microswarm::reproduce
