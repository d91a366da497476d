// SPDX-License-Identifier: Apache-2.0
#include "bench/gathering.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/navigation/gathering/gather.hpp"
#include "microswarm/navigation/gathering/policies/published_scale.hpp"
#include "microswarm/scenes/vascular.hpp"

namespace microswarm::bench {
namespace {

constexpr int gather_steps = 100'000;

/// A map, the parameters on it and the rule by which robots move.
struct GatheringCase {
  std::string name;
  Map map;
  Vec2 goal;
  navigation::AggregationParams params;
  navigation::MoveRule rule;
  std::size_t robots;
};

/// A maze with its goal, as column and row from the upper left.
struct Maze {
  const char* name;
  double column;
  double row;
};
constexpr std::array<Maze, 4> mazes{
    {{"corridor", 82, 80}, {"capillary", 61, 130}, {"brain", 96, 204}, {"vessel", 85, 66}}};

GatheringCase maze_task(const std::filesystem::path& folder, const Maze& maze,
                        navigation::MoveRule rule) {
  constexpr std::size_t particles = 256;
  const auto file = folder / (std::string(maze.name) + ".pgm");
  GatheringCase task{
      maze.name, *formats::load_map(formats::guess_map_spec(file, 1)).map, {}, {}, rule, particles};
  const Box& box = task.map.bounds();
  task.goal = {box.lo.x + maze.column + 0.5, box.hi.y - maze.row - 0.5};
  Rng rng(1, Purpose::planner);
  task.params.scale = 0;
  const double scale = navigation::published_scale(task.params, task.map, rng);
  if (rule == navigation::MoveRule::any_direction) {
    task.params.scale = scale;
    task.params = navigation::fitted(task.params, task.map, rng);
    task.name += ", any direction, mean way of a channel's width";
  } else {
    task.params.scale = 1;
    task.params.tree = planning::scaled(task.params.tree, scale);
    task.params.sigma = 10.5;  // whole steps: all within 10
    task.params.gathered = navigation::Gathered::all;
    task.name += ", the set's rules";
  }
  return task;
}

/// Channels drawn by hand, 100 × 90.
scenes::Vascular drawn_network() {
  scenes::ChannelGraph graph;
  graph.bounds = {{0, 0}, {100, 90}};
  constexpr double half = 4.5;
  constexpr std::array<Vec2, 19> joints{{{93, 6},
                                         {93, 28},
                                         {70, 26},
                                         {72, 50},
                                         {93, 54},
                                         {93, 83},
                                         {68, 80},
                                         {48, 60},
                                         {46, 32},
                                         {46, 7},
                                         {24, 24},
                                         {6, 26},
                                         {22, 50},
                                         {6, 56},
                                         {26, 78},
                                         {46, 84},
                                         {6, 84},
                                         {20, 6},
                                         {72, 6}}};
  for (const Vec2 p : joints) graph.joints.push_back({p, half});
  graph.channels = {{0, 1},   {1, 2},  {2, 3},   {3, 4},   {4, 5},   {3, 7},   {7, 8},   {8, 2},
                    {8, 9},   {8, 10}, {10, 11}, {10, 12}, {12, 13}, {12, 14}, {14, 15}, {14, 16},
                    {10, 17}, {2, 18}, {5, 6},   {6, 3},   {6, 15},  {17, 9},  {9, 18}};
  return {"drawn_network", graph.bounds, scenes::graph_walls(graph), {93, 4.5}, 10'000, 2 * half};
}

GatheringCase scene_task(const std::string& name, const scenes::Vascular& scene) {
  constexpr std::size_t robots = 1024;
  constexpr double work = 40e6;
  GatheringCase task{name,  scene.map(), scene.goal, {}, navigation::MoveRule::any_direction,
                     robots};
  task.params.tree.nodes = scene.nodes;
  task.params.rollout.max_work = work;
  return task;
}

Robots random_robots(const GatheringCase& task, const navigation::AggregationMap& map,
                     const RobotStepper& stepper, Rng& rng) {
  if (map.cells) {
    std::vector<std::uint32_t> nodes(map.cells->size());
    std::iota(nodes.begin(), nodes.end(), 0u);
    for (std::size_t i = 0; i < task.robots; ++i)
      std::swap(nodes[i], nodes[i + rng.below(nodes.size() - i)]);
    nodes.resize(task.robots);
    return navigation::robots_at(*map.cells, nodes);
  }
  std::vector<Vec2> positions;
  while (positions.size() < task.robots) {
    const Vec2 p = uniform_in(task.map.bounds(), rng);
    if (map.map.is_free(p, 4 * stepper.guard())) positions.push_back(p);
  }
  return stepper.place(positions);
}

/// Steps of each seed, and the time of all.
struct Gatherings {
  std::vector<double> steps;
  double seconds = 0;
};

Gatherings gather_all(const GatheringCase& task, navigation::AggregationParams params,
                      navigation::Aggregation method, int seeds, const Stop& stop) {
  params.method = method;
  Rng tree(1, Purpose::planner);
  const navigation::AggregationMap map(task.map, task.goal, params, tree, task.rule);
  const RobotStepper stepper(task.map, params.step);
  const navigation::CommonInput input =
      map.cells ? navigation::CommonInput(*map.cells) : navigation::CommonInput(stepper);
  Gatherings all;
  for (int seed = 1; seed <= seeds && !stop(); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), Purpose::scene);
    Robots robots = random_robots(task, map, stepper, rng);
    const auto began = Stop::Clock::now();
    if (method == navigation::Aggregation::rollout) {
      navigation::RolloutPolicy policy(map, input, params,
                                       Rng(static_cast<std::uint64_t>(seed), Purpose::planner));
      all.steps.push_back(gather(input, policy, robots, gather_steps, stop).steps);
    } else {
      navigation::AggregationPolicy policy(map, params);
      all.steps.push_back(gather(input, policy, robots, gather_steps, stop).steps);
    }
    all.seconds += seconds_since(began);
  }
  return all;
}

/// A row for each method, beside dynamic shortest path; without `aim` rollout's is 30 % fewer
/// steps.
void add_rows(std::vector<report::BenchRow>& rows, const GatheringCase& task,
              std::optional<double> aim, int seeds, const Stop& stop) {
  const Gatherings peer =
      gather_all(task, task.params, navigation::Aggregation::dynamic_shortest_path, seeds, stop);
  if (stop()) return;
  const double peer_steps = mean(peer.steps);
  rows.push_back({.name = task.name + ", dynamic shortest path",
                  .quantity = fmt::format("steps, ± {:.0f}", standard_deviation(peer.steps)),
                  .unit = "1",
                  .ours = peer_steps});
  for (const navigation::Aggregation method :
       {navigation::Aggregation::rollout, navigation::Aggregation::divide_and_conquer,
        navigation::Aggregation::heuristic}) {
    const Gatherings ours = gather_all(task, task.params, method, seeds, stop);
    if (stop()) return;
    report::BenchRow row{.name = fmt::format("{}, {}", task.name, enum_name(method)),
                         .quantity = fmt::format("steps, ± {:.0f}", standard_deviation(ours.steps)),
                         .unit = "1",
                         .ours = mean(ours.steps),
                         .peer = peer_steps,
                         .peer_name = "dynamic shortest path"};
    if (method == navigation::Aggregation::rollout) row.aim = aim.value_or(0.7 * peer_steps);
    rows.push_back(std::move(row));
  }
}

/// Times of the same search on one thread and on two.
void add_thread_row(std::vector<report::BenchRow>& rows, const GatheringCase& task, int seeds,
                    const Stop& stop) {
  navigation::AggregationParams params = task.params;
  params.rollout.tuning.changes_work = 0;
  const Gatherings one = gather_all(task, params, navigation::Aggregation::rollout, seeds, stop);
  params.rollout.threads = 2;
  const Gatherings two = gather_all(task, params, navigation::Aggregation::rollout, seeds, stop);
  if (stop()) return;
  rows.push_back({.name = task.name + ", search by layers",
                  .quantity = "speed on two threads over one",
                  .unit = "1",
                  .ours = one.seconds / two.seconds,
                  .aim = 1.8,
                  .at_most = false});
}

}  // namespace

std::vector<report::BenchRow> gather(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows;
  const int seeds = quick ? 2 : 5;
  add_rows(rows, scene_task("T-junction, n = 1024", scenes::t_junction()), 170, seeds, stop);
  add_rows(rows, scene_task("drawn map, 100 × 90, n = 1024", drawn_network()), 340, seeds, stop);
  const GatheringCase large =
      scene_task("generated map, 400 × 314, n = 1024", scenes::generated_vascular_network());
  add_rows(rows, large, 3300, seeds, stop);
  add_thread_row(rows, large, quick ? 1 : 3, stop);
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) return rows;
  const std::filesystem::path folder = std::filesystem::path(data) / "gym_gathering";
  if (!std::filesystem::exists(folder)) return rows;
  for (const navigation::MoveRule rule :
       {navigation::MoveRule::cells, navigation::MoveRule::any_direction})
    for (const Maze& maze : mazes) {
      if (stop()) return rows;
      GatheringCase task = maze_task(folder, maze, rule);
      if (quick) task.params.rollout.max_work = 20e6;
      add_rows(rows, task, std::nullopt, seeds, stop);
    }
  return rows;
}

}  // namespace microswarm::bench
