// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/record/global_tree_file.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/reproduce/global/global.hpp"
#include "microswarm/scenes/global_worlds.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;
using Clock = Stop::Clock;

constexpr int published_nodes = 341'997;
constexpr const char* map_of_ours =
    "map, starts and goals are ours, the paper's are only in a picture";

/// A setting of the tree: as in the paper, with the goal bias of OMPL's RRT, which the paper's
/// program uses, and also with that program's contact rule.
struct TreeSetting {
  const char* name;
  const char* file;
  ContactRule contact;
  double goal_bias;
};
constexpr std::array<TreeSetting, 3> tree_settings{
    {{"tree as printed", "printed", ContactRule::slide, 0},
     {"tree with goal bias 5 %", "bias", ContactRule::slide, 0.05},
     {"tree with goal bias 5 %, reject", "reject", ContactRule::reject, 0.05}}};

planning::GlobalRrtParams parameters(const TreeSetting& setting, int nodes) {
  planning::GlobalRrtParams params;
  params.contact = setting.contact;
  params.goal_bias = setting.goal_bias;
  params.max_nodes = nodes;
  return params;
}

Rng tree_rng(std::size_t seed) { return {1, Purpose::planner, static_cast<std::uint32_t>(seed)}; }

double percentage(std::ptrdiff_t part, std::size_t all) {
  return 100 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, all));
}

/// Whether several trees solve a task for which the paper shows one tree.
report::ReproduceRow solved_row(const char* figure, const std::string& what, std::ptrdiff_t solved,
                                std::size_t seeds, const ReproduceOptions& options) {
  return unjudged_if_quick(noted(row_at_least(0, figure, what, "%", 100, percentage(solved, seeds)),
                                 fmt::format("{} of {} trees; the paper shows one", solved, seeds)),
                           options);
}

/// Result of a tree for one of the two sets of goals of Fig 9 and 10.
struct TreeAnswer {
  planning::GoalAnswer answer;
  planning::GlobalPlan plan;
};
using TreeAnswers = std::vector<std::array<TreeAnswer, 2>>;  // one per seed

constexpr std::array<std::span<const Vec2>, 2> goal_sets{scenes::global_goals,
                                                         scenes::global_other_goals};
constexpr std::array<const char*, 2> goal_figures{"fig9", "fig10"};

TreeAnswers measure_answers(const Map& map, const TreeSetting& setting, std::size_t seeds,
                            const Stop& stop) {
  TreeAnswers answers(seeds);
  planning::GlobalRrtParams params = parameters(setting, published_nodes);
  params.stop_at_first = false;
  for_each_index(seeds, 0, [&](std::size_t seed) {
    Rng rng = tree_rng(seed);
    const planning::GlobalTree tree =
        planning::global_rrt(map, scenes::global_starts, scenes::global_goals, params, rng, stop)
            .tree;
    for (std::size_t k = 0; k < goal_sets.size(); ++k) {
      TreeAnswer& a = answers[seed][k];
      a.answer = planning::ask(tree, goal_sets[k], params.goal_tolerance);
      a.plan = planning::plan_to(tree, a.answer);
    }
  });
  return answers;
}

/// Costs of storing a tree.
void add_costs(const formats::LoadedMap& map, const ReproduceOptions& options, const Stop& stop,
               std::vector<report::ReproduceRow>& rows) {
  Rng rng = tree_rng(0);
  auto began = Clock::now();
  const planning::GlobalTree tree =
      planning::global_rrt(*map.map, scenes::global_starts, {},
                           parameters(tree_settings[0], published_nodes), rng, stop)
          .tree;
  const double growing = seconds_since(began);
  if (stop()) return;
  const fs::path file = options.out.empty() ? fs::temp_directory_path() /
                                                  fmt::format("microswarm_tree_{}.h5", ::getpid())
                                            : fs::path(options.out) / "fig9-tree.h5";
  experiment::write_global_tree(tree, map, file);
  began = Clock::now();
  const planning::GlobalTree loaded = experiment::read_global_tree(file, map);
  const double loading = seconds_since(began);
  const auto bytes = static_cast<double>(fs::file_size(file));
  if (options.out.empty()) fs::remove(file);
  began = Clock::now();
  planning::ask(loaded, scenes::global_other_goals, 20);
  const double asking = 1e3 * seconds_since(began);
  const auto nodes = static_cast<double>(tree.size());
  rows.push_back(make_row("fig9", "nodes per second", "1/s", {}, nodes / growing));
  rows.push_back(make_row("fig10", "bytes a node of the tree's file", "B", {}, bytes / nodes));
  rows.push_back(make_row("fig10", "loading the tree, every input played", "s", {}, loading));
  rows.push_back(make_row("fig10", "asking the tree for other goals", "ms", {}, asking));
}

/// The network shipped with the published program, by trees and by the search.
void add_leaf(const scenes::GlobalTask& leaf, int search_seeds, const ReproduceOptions& options,
              const Stop& stop, std::vector<report::ReproduceRow>& rows) {
  const int nodes = options.quick ? 20'000 : 60'000;
  const std::size_t seeds = options.quick ? 2 : 10;
  for (const TreeSetting& setting : tree_settings) {
    std::vector<TreeAnswer> answers(seeds);
    for_each_index(seeds, 0, [&](std::size_t seed) {
      planning::GlobalRrtParams params = parameters(setting, nodes);
      params.robostep = leaf.robostep;
      params.goal_tolerance = leaf.tolerance;
      Rng rng = tree_rng(seed);
      const planning::GlobalRrt grown =
          planning::global_rrt(leaf.map, leaf.starts, leaf.goals, params, rng, stop);
      answers[seed] = {grown.answer, planning::plan_to(grown.tree, grown.answer)};
    });
    if (stop()) return;
    const auto solved = std::ranges::count(answers, Status::solved,
                                           [](const TreeAnswer& a) { return a.answer.status; });
    rows.push_back(noted(row_without_aim("the paper gives no nodes", "fig1",
                                         fmt::format("{}, 3 robots, {}, {} nodes: solved",
                                                     leaf.name, setting.name, nodes),
                                         "%", 100, percentage(solved, seeds)),
                         fmt::format("{} of {} trees", solved, seeds)));
    const auto best =
        std::ranges::min_element(answers, {}, [](const TreeAnswer& a) { return a.answer.worst; });
    draw_plan(options, fmt::format("fig1-leaf-{}", setting.file),
              fmt::format("{}, {}, best of {}: worst robot {:.1f} µm off", leaf.name, setting.name,
                          seeds, best->answer.worst),
              leaf.map, best->plan, leaf.goals, leaf.tolerance);
  }
  scenes::GlobalTask fine = leaf;
  fine.robostep = 2;
  fine.tolerance = 4;
  const auto more = search_task("fig1", "fig1-leaf", fine, {}, search_seeds, options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

// The paper does not say which of the program's two networks the figure shows, and one of them has
// no file.
std::vector<report::ReproduceRow> global_vascular(const ReproduceOptions& options,
                                                  const Stop& stop) {
  const int seeds = options.quick ? 1 : 5;
  std::vector<report::ReproduceRow> rows;
  if (const auto file =
          data_file(options, "paper_authors/global_leaf.csv", "fig1, veins of a leaf"))
    add_leaf(scenes::leaf_task(*formats::load_map(formats::guess_map_spec(*file)).map), seeds,
             options, stop, rows);
  const auto more = search_task("fig1", "fig1", scenes::vascular_task(), {}, seeds, options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

// Trees of four robots in Env 3 are queried for two sets of goals.
std::vector<report::ReproduceRow> global_reuse(const ReproduceOptions& options, const Stop& stop) {
  const formats::LoadedMap map{std::make_shared<const Map>(scenes::global_world(3)), 3};
  const std::size_t seeds = options.quick ? 1 : 20;
  std::vector<report::ReproduceRow> rows;
  std::array<TreeAnswer, 2> best;
  std::array<const char*, 2> best_setting{};
  for (TreeAnswer& a : best) a.answer.worst = std::numeric_limits<double>::infinity();
  for (const TreeSetting& setting : tree_settings) {
    const TreeAnswers answers = measure_answers(*map.map, setting, seeds, stop);
    if (stop()) return rows;
    for (std::size_t k = 0; k < goal_sets.size(); ++k) {
      std::vector<double> worst;
      for (const auto& of_tree : answers) {
        worst.push_back(of_tree[k].answer.worst);
        if (worst.back() < best[k].answer.worst)
          best[k] = of_tree[k], best_setting[k] = setting.name;
      }
      const auto solved = std::ranges::count(
          answers, Status::solved, [&](const auto& of_tree) { return of_tree[k].answer.status; });
      const std::string what = fmt::format("{}, {} nodes: ", setting.name, published_nodes);
      rows.push_back(
          solved_row(goal_figures[k], what + "four robots solved", solved, seeds, options));
      rows.push_back(row_without_aim("20 µm are allowed; judged by the row above", goal_figures[k],
                                     what + "worst robot's distance from its goal, median", "µm",
                                     20, median(worst)));
    }
  }
  for (std::size_t k = 0; k < goal_sets.size(); ++k)
    draw_plan(options, goal_figures[k],
              fmt::format("Env 3, {}, best of {}: worst robot {:.1f} µm off", best_setting[k],
                          seeds, best[k].answer.worst),
              *map.map, best[k].plan, goal_sets[k]);
  add_costs(map, options, stop, rows);
  scenes::GlobalTask task{"Env 3", *map.map, {}, {}};
  task.starts.assign(scenes::global_starts.begin(), scenes::global_starts.end());
  planning::GlobalSearchParams params;
  if (options.quick) params.max_nodes = 50'000;
  for (std::size_t k = 0; k < goal_sets.size(); ++k) {
    task.goals.assign(goal_sets[k].begin(), goal_sets[k].end());
    const auto more = search_task(goal_figures[k], k == 0 ? "fig9-search" : "fig10-search", task,
                                  params, options.quick ? 1 : 5, options, stop);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

// Inputs along the axes only, so that cylinders meet walls perpendicularly; then a search that
// keeps the magnets apart, which the paper does not specify.
std::vector<report::ReproduceRow> global_magnets(const ReproduceOptions& options,
                                                 const Stop& stop) {
  const scenes::GlobalTask task = scenes::magnets_task();
  constexpr int nodes = 40'000;
  planning::GlobalRrtParams params = parameters(tree_settings[0], nodes);
  params.robostep = task.robostep;
  params.goal_tolerance = task.tolerance;
  params.directions = 4;
  const std::size_t seeds = options.quick ? 3 : 10;
  std::vector<double> needed;
  std::ptrdiff_t solved = 0;
  double apart = std::numeric_limits<double>::infinity();
  for (std::size_t seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng = tree_rng(seed);
    const planning::GlobalRrt grown =
        planning::global_rrt(task.map, task.starts, task.goals, params, rng, stop);
    const planning::GlobalPlan plan = planning::plan_to(grown.tree, grown.answer);
    needed.push_back(static_cast<double>(grown.tree.size()));
    if (seed == 0)
      draw_plan(options, "fig12",
                fmt::format("Two magnets, inputs along the axes: {} inputs", plan.inputs.size()),
                task.map, plan, task.goals, task.tolerance);
    if (plan.status != Status::solved) continue;
    ++solved;
    apart = std::min(apart, min_distance(plan));
  }
  if (stop()) return {};
  const std::string what = fmt::format("two magnets, tree of {} nodes: ", nodes);
  std::vector<report::ReproduceRow> rows{
      noted(row_without_aim(map_of_ours, "fig12", what + "solved", "%", 100,
                            percentage(solved, needed.size())),
            fmt::format("{} of {} trees", solved, needed.size())),
      row_without_aim(map_of_ours, "fig12", what + "nodes until solved or all, median", "1", nodes,
                      median(needed)),
      make_row("fig12", what + "least distance between the magnets", "µm", {},
               solved > 0 ? std::optional(apart) : std::nullopt)};
  planning::GlobalSearchParams keeps_apart;
  keeps_apart.directions = 4;
  keeps_apart.separation = 40;
  scenes::GlobalTask named = task;
  named.name += " that keep 40 µm apart";
  const auto more =
      search_task("fig12", "fig12-apart", named, keeps_apart, int(seeds), options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace microswarm::reproduce
