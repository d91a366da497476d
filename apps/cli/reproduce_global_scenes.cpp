// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "microswarm/core/statistics.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/experiment/global_tree_file.hpp"
#include "microswarm/planning/global_rrt.hpp"
#include "microswarm/planning/global_search.hpp"
#include "microswarm/planning/global_shorten.hpp"
#include "reproduce_global.hpp"
#include "robot_picture.hpp"
#include "tests/scenes/global_tasks.hpp"
#include "tests/scenes/global_worlds.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;
using Clock = Stop::Clock;

Stop within(double seconds) {
  return Stop(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
}

/// Least distance between two robots at the ends of a plan's inputs.
double least_distance(const GlobalPlan& plan) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& places : plan.configurations)
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(places[i], places[j]));
  return least;
}

/// A task by the search beyond the paper, with some seeds; the first one's plan is drawn.
std::vector<ReproduceRow> searched(const char* figure, const char* name,
                                   const scenes::GlobalTask& task, GlobalSearchParams params,
                                   int seeds, double seconds, const ReproduceOptions& options,
                                   const Stop& stop) {
  params.robostep = task.robostep;
  params.goal_tolerance = task.tolerance;
  const GlobalPlay play{params.robostep, params.contact, params.separation, params.goal_tolerance};
  std::vector<double> times, found, brief, apart;
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = Clock::now();
    GlobalPlan plan =
        global_search(task.map, task.starts, task.goals, params, rng, within(seconds)).plan;
    if (plan.status == Status::solved) {
      times.push_back(seconds_since(began));
      found.push_back(static_cast<double>(plan.inputs.size()));
      plan = shortened(task.map, plan, task.goals, play, within(5));
      brief.push_back(static_cast<double>(plan.inputs.size()));
      apart.push_back(least_distance(plan));
    }
    if (seed == 0)
      draw_plan(options, name,
                fmt::format("{}: {} robots, {} inputs", task.name, task.starts.size(),
                            plan.inputs.size()),
                task.map, plan, task.goals, task.tolerance);
  }
  const std::string who = fmt::format("{}, {} robots", task.name, task.starts.size());
  std::vector<ReproduceRow> rows{
      row_of(figure, fmt::format("{}: solved within {:g} s, of {}", who, seconds, seeds), "1", {},
             static_cast<double>(times.size()), seeds, false)};
  if (times.empty()) return rows;
  rows.push_back(row_of(figure, who + ": time, median", "s", {}, median(times)));
  rows.push_back(row_of(figure, who + ": inputs, median", "1", {}, median(found)));
  rows.push_back(row_of(figure, who + ": inputs when shortened, median", "1", {}, median(brief)));
  if (params.separation > 0)
    rows.push_back(row_of(figure, who + ": least distance between robots", "µm", {},
                          *std::ranges::min_element(apart), params.separation - 1e-3, false));
  return rows;
}

}  // namespace

void draw_plan(const ReproduceOptions& options, const std::string& name, const std::string& title,
               const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
               double tolerance) {
  if (options.out.empty()) return;
  for (const char* kind : {".png", ".svg", ".pdf"})
    draw_robots(map, plan, goals, tolerance, title, fs::path(options.out) / (name + kind));
}

std::vector<ReproduceRow> global_vascular(const ReproduceOptions& options, const Stop& stop) {
  return searched("fig1", "fig1", scenes::vascular_task(), {}, options.quick ? 1 : 5, 60, options,
                  stop);
}

std::vector<ReproduceRow> global_digestive(const ReproduceOptions& options, const Stop& stop) {
  return searched("fig8", "fig8", scenes::digestive_task(), {}, options.quick ? 1 : 5, 30, options,
                  stop);
}

// A tree of four robots in Env 3 is asked for several goals, from memory and from its file.
std::vector<ReproduceRow> global_reuse(const ReproduceOptions& options, const Stop& stop) {
  LoadedMap map{std::make_shared<const Map>(scenes::global_world(3)), 3};
  GlobalRrtParams params;
  params.max_nodes = options.quick ? 60'000 : 341'997;
  Rng rng(1, Purpose::planner, 0);
  auto began = Clock::now();
  const GlobalTree tree = global_rrt(*map.map, scenes::global_starts, {}, params, rng, stop).tree;
  const double growing = seconds_since(began);

  const fs::path file = options.out.empty() ? fs::temp_directory_path() /
                                                  fmt::format("microswarm_tree_{}.h5", ::getpid())
                                            : fs::path(options.out) / "fig9-tree.h5";
  write_global_tree(tree, map, file);
  began = Clock::now();
  const GlobalTree loaded = read_global_tree(file, map);
  const double loading = seconds_since(began);
  const auto bytes = static_cast<double>(fs::file_size(file));
  if (options.out.empty()) fs::remove(file);

  std::vector<double> asking;
  int solved = 0, same = 0;
  double worst = std::numeric_limits<double>::infinity();
  for (const bool other : {false, true}) {
    const std::span<const Vec2> goals =
        other ? std::span<const Vec2>(scenes::global_other_goals) : scenes::global_goals;
    GoalAnswer answer;
    for (int k = 0; k < 5; ++k) {
      began = Clock::now();
      answer = ask(loaded, goals, 20);
      asking.push_back(1e3 * seconds_since(began));
    }
    solved += answer.status == Status::solved;
    same += answer.node == ask(tree, goals, 20).node;
    worst = std::min(worst, answer.worst);
    draw_plan(options, other ? "fig10" : "fig9",
              fmt::format("Env 3, four robots, plain tree of {} nodes: worst robot {:.0f} µm off",
                          tree.size(), answer.worst),
              *map.map, plan_to(loaded, answer), goals);
  }
  return {row_of("fig9", "four robots in Env 3, plain tree: nodes", "1", 341'997,
                 static_cast<double>(tree.size())),
          row_of("fig9", "nodes per second", "1/s", {}, static_cast<double>(tree.size()) / growing),
          row_of("fig9", "bytes a node of the tree's file", "B", {},
                 bytes / static_cast<double>(tree.size())),
          row_of("fig10", "loading the tree, every input played", "s", {}, loading),
          row_of("fig10", "the same answers as before it was saved, of 2", "1", {}, same, 2, false),
          row_of("fig10", "goals solved by the plain tree, of 2", "1", 2, solved),
          row_of("fig10", "worst robot's distance from its goal, the better of 2", "µm", 20, worst),
          row_of("fig10", "asking the tree for another goal", "ms", {}, median(asking), 5)};
}

// Inputs along the axes only, so that cylinders meet walls squarely; then a search that keeps the
// magnets apart, which the paper leaves open.
std::vector<ReproduceRow> global_magnets(const ReproduceOptions& options, const Stop& stop) {
  const scenes::GlobalTask task = scenes::magnets_task();
  GlobalRrtParams params;
  params.robostep = task.robostep;
  params.goal_tolerance = task.tolerance;
  params.directions = 4;
  const int seeds = options.quick ? 3 : 10;
  int solved = 0;
  std::vector<double> nodes;
  double apart = std::numeric_limits<double>::infinity();
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const GlobalRrt grown = global_rrt(task.map, task.starts, task.goals, params, rng, stop);
    const GlobalPlan plan = plan_to(grown.tree, grown.answer);
    if (seed == 0)
      draw_plan(options, "fig12",
                fmt::format("Two magnets, inputs along the axes: {} inputs", plan.inputs.size()),
                task.map, plan, task.goals, task.tolerance);
    if (plan.status != Status::solved) continue;
    ++solved;
    nodes.push_back(static_cast<double>(grown.tree.size()));
    apart = std::min(apart, least_distance(plan));
  }
  std::vector<ReproduceRow> rows{
      row_of("fig12", fmt::format("two magnets, plain tree of 40,000 nodes: solved, of {}", seeds),
             "1", {}, solved, seeds / 2, false),
      row_of("fig12", "nodes until solved, median", "1", 40'000, median(nodes)),
      row_of("fig12", "least distance between the magnets", "µm", {}, apart)};
  GlobalSearchParams keeps_apart;
  keeps_apart.directions = 4;
  keeps_apart.separation = 40;
  scenes::GlobalTask named = scenes::magnets_task();
  named.name += " that keep 40 µm apart";
  const auto more = searched("fig12", "fig12-apart", named, keeps_apart, seeds, 10, options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

// Beyond the paper, which shows four.
std::vector<ReproduceRow> global_six(const ReproduceOptions& options, const Stop& stop) {
  scenes::GlobalTask task = scenes::six_robots(1);
  task.name = "Env 1";
  auto rows = searched("beyond", "env1-n6", task, {}, options.quick ? 1 : 3,
                       options.quick ? 10 : 120, options, stop);
  rows.front().aim = options.quick ? std::nullopt : std::optional(1.0);
  task.name = "Env 1, goals apart";
  task.goals = scenes::six_goals_apart();
  const auto more = searched("beyond", "env1-n6-apart", task, {}, options.quick ? 1 : 3,
                             options.quick ? 10 : 120, options, stop);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace microswarm::cli
