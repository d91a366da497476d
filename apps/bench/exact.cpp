// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/planning/exact/shortest_path_tree.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/planning/path/fit_to_map.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

double spent_ms(Clock::time_point began) { return 1e3 * seconds_since(began); }

void require_solved(bool solved) {
  if (!solved) throw std::runtime_error("bench: a query was not solved");
}

/// Times [ms] of exact queries that begin anew.
std::vector<double> anew_times(const Map& map, double clearance,
                               const std::vector<PathQuery>& queries, const Stop& stop) {
  std::vector<double> ms;
  for (const PathQuery& q : queries) {
    if (stop()) break;
    const auto began = Clock::now();
    ShortestPaths paths(map, clearance);
    const ShortestPath found = paths.find(q.start.position, q.goal);
    ms.push_back(spent_ms(began));
    require_solved(found.status == Status::solved);
  }
  return ms;
}

/// Times [ms] of a planner.
std::vector<double> plan_times(const Snapshot& world, const std::vector<PathQuery>& queries,
                               const PlannerParams& params, const Stop& stop) {
  std::vector<double> ms;
  Rng rng(1, Purpose::planner);
  for (const PathQuery& q : queries) {
    if (stop()) break;
    const auto began = Clock::now();
    const Plan made = plan(world, q.start, q.goal, params, rng);
    ms.push_back(spent_ms(began));
    require_solved(made.status == Status::solved);
  }
  return ms;
}

/// Times [ms] of exact queries that find the tangents of those before.
std::vector<double> kept_times(ShortestPaths& paths, const std::vector<PathQuery>& queries,
                               const Stop& stop) {
  std::vector<double> ms;
  for (const bool counts : {false, true})
    for (const PathQuery& q : queries) {
      if (stop()) break;
      const auto began = Clock::now();
      const ShortestPath found = paths.find(q.start.position, q.goal);
      if (counts) ms.push_back(spent_ms(began));
      require_solved(found.status == Status::solved);
    }
  return ms;
}

/// Lengths of the paths from all starts to the first goal, out of one tree: the time [ms] it takes
/// to grow and ask it, and the times of asking it again where there is a path.
struct TreeTimes {
  double grown = 0;
  std::vector<double> again;
};
TreeTimes tree_times(const Map& map, double clearance, const std::vector<PathQuery>& queries,
                     const Stop& stop) {
  TreeTimes times;
  ShortestPathTree tree(map, queries.front().goal, clearance);
  for (const bool counts : {false, true})
    for (const PathQuery& q : queries) {
      if (stop()) break;
      const auto began = Clock::now();
      const bool reaches = tree.length_from(q.start.position) < infinity;
      const double ms = spent_ms(began);
      if (!counts) times.grown += ms;
      if (counts && reaches) times.again.push_back(ms);
    }
  require_solved(stop() || 2 * times.again.size() > queries.size());
  return times;
}

void add_tree_rows(const std::string& where, const TreeTimes& times, double aim,
                   std::vector<BenchRow>& rows) {
  rows.push_back({.name = "exact, " + where + ", one goal, tree of paths kept",
                  .quantity = "time, median",
                  .unit = "ms",
                  .ours = quantile(times.again, 0.5),
                  .aim = aim});
  rows.push_back({.name = "exact, " + where + ", one goal, growing the tree for all starts",
                  .quantity = "time",
                  .unit = "ms",
                  .ours = times.grown});
}

double corners_ms(const Map& map, int repeats) {
  std::vector<double> ms;
  for (int i = 0; i < repeats; ++i) {
    const auto began = Clock::now();
    const Corners corners(map.walls(), map.bounds());
    ms.push_back(spent_ms(began));
  }
  return quantile(ms, 0.5);
}

std::vector<BenchRow> among_discs_and_polygons(bool quick, const Stop& stop) {
  constexpr double clearance = 10;
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  const std::vector<PathQuery> queries = far_pairs(world, clearance, quick ? 100 : 1000, rng);
  std::vector<double> theirs;
  for (const PathQuery& q : queries) {
    if (stop()) break;
    theirs.push_back(1e3 * run_ompl(OmplPlanner::rrt_connect, {.world = world,
                                                               .start = q.start.position,
                                                               .goal = q.goal,
                                                               .clearance = clearance,
                                                               .goal_tolerance = 50,
                                                               .range = 80})
                               .seconds);
  }
  std::vector<BenchRow> rows;
  using Aim = std::optional<double>;
  const auto add = [&](const char* name, const std::vector<double>& ours, Aim median, Aim p99) {
    for (BenchRow& row : time_rows(name, ours, theirs, "OMPL RRTConnect, first path", median, p99))
      rows.push_back(std::move(row));
  };
  world.map().corners();
  add("exact, 140 discs and 70 polygons, each query anew",
      anew_times(world.map(), clearance, queries, stop), {}, {});
  ShortestPaths paths(world.map(), clearance);
  add("exact, 140 discs and 70 polygons, tangents kept", kept_times(paths, queries, stop), 0.05,
      0.2);
  rows.push_back({.name = "exact, corners of 140 discs and 70 polygons",
                  .quantity = "time, median",
                  .unit = "ms",
                  .ours = corners_ms(world.map(), 11)});
  add_tree_rows("140 discs and 70 polygons", tree_times(world.map(), clearance, queries, stop),
                0.05, rows);
  return rows;
}

template <class Params>
Params on_grid(double clearance) {
  Params params;
  params.clearance = clearance;
  return params;
}

/// Time and length of a planner whose other values follow from the map.
std::vector<BenchRow> fitted_to(const std::string& map, const Snapshot& world,
                                const std::vector<PathQuery>& queries, PlannerParams planner,
                                ShortestPaths& paths, const Stop& stop) {
  planner =
      fit_to_map(planner, world.map(), [](std::string_view key) { return key == "clearance_um"; });
  std::vector<double> ms, excess;
  for (const PathQuery& q : queries) {
    if (stop()) break;
    Rng rng(1, Purpose::planner);
    const auto began = Clock::now();
    const Plan made = plan(world, q.start, q.goal, planner, rng, stop);
    ms.push_back(spent_ms(began));
    const ShortestPath best = paths.find(q.start.position, q.goal, stop);
    require_solved(made.status == Status::solved);
    const double left = distance(made.path.back(), q.goal);  // within the tolerance
    excess.push_back((path_length(made) + left) / best.length);
  }
  const std::string name =
      std::visit([](const auto& p) { return std::string(p.type_name); }, planner) + ", " + map +
      ", fitted to it";
  return {{.name = name,
           .quantity = "time, median",
           .unit = "ms",
           .ours = quantile(ms, 0.5),
           .aim = 20},
          {.name = name,
           .quantity = "length beside the shortest, median",
           .unit = "",
           .ours = quantile(excess, 0.5)}};
}

/// Cells of 100 µm, a swarm that keeps 40 µm from walls.
std::vector<BenchRow> in_grid_map(const std::filesystem::path& file, bool quick, const Stop& stop) {
  constexpr double cell = 100, clearance = 40;
  const std::string name = file.stem().string();
  const Mask blocked = read_moving_ai(file);
  const auto map =
      std::make_shared<const Map>(cell_bounds(blocked, cell), mask_walls(blocked, cell));
  const Snapshot world(map);
  std::vector<PathQuery> queries;
  const auto all = read_scenarios(file.string() + ".scen");
  const std::size_t count = std::min<std::size_t>(all.size(), quick ? 20 : 200);
  for (std::size_t i = 0; i < count; ++i) {
    const GridQuery& q = all[i * all.size() / count];
    queries.push_back({{cell_centre(blocked, q.start.column, q.start.row, cell), 0},
                       cell_centre(blocked, q.goal.column, q.goal.row, cell)});
  }
  std::vector<PathQuery> few;
  for (std::size_t i = 0; i < queries.size(); i += quick ? 5 : 20) few.push_back(queries[i]);
  const AStarParams a_star{{.clearance = clearance, .goal_tolerance = 25, .cell = cell}};
  ShortestPaths paths(*map, clearance);
  std::vector<BenchRow> rows{{.name = "exact, " + name + ", tangents kept",
                              .quantity = "time, median",
                              .unit = "ms",
                              .ours = quantile(kept_times(paths, queries, stop), 0.5),
                              .peer = quantile(plan_times(world, few, a_star, stop), 0.5),
                              .peer_name = "our A*, cells of the map",
                              .aim = 1},
                             {.name = "exact, " + name + ", each query anew",
                              .quantity = "time, median",
                              .unit = "ms",
                              .ours = quantile(anew_times(*map, clearance, few, stop), 0.5)},
                             {.name = "exact, corners of " + name,
                              .quantity = "time, median",
                              .unit = "ms",
                              .ours = corners_ms(*map, 3),
                              .aim = 300}};
  add_tree_rows(name, tree_times(*map, clearance, few, stop), 1, rows);
  for (const PlannerParams& planner : {PlannerParams(on_grid<AStarParams>(clearance)),
                                       PlannerParams(on_grid<ThetaStarParams>(clearance))})
    for (BenchRow& row : fitted_to(name, world, few, planner, paths, stop))
      rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::vector<BenchRow> exact_paths(bool quick, const Stop& stop) {
  std::vector<BenchRow> rows = among_discs_and_polygons(quick, stop);
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) return rows;
  for (const char* name :
       {"arena", "den312d", "Berlin_0_256", "32room_000", "random512-10-0", "maze512-32-0"}) {
    const auto file = std::filesystem::path(data) / "grid_maps" / (std::string(name) + ".map");
    if (!std::filesystem::exists(file) || stop()) continue;
    for (BenchRow& row : in_grid_map(file, quick, stop)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace microswarm::bench
