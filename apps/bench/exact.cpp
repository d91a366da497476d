// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <span>
#include <stdexcept>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/planning/exact/distance_field.hpp"
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

/// Times [ms] of exact queries without kept tangents.
std::vector<double> anew_times(const Map& map, double clearance,
                               const std::vector<PathQuery>& queries, const Stop& stop) {
  std::vector<double> ms;
  for (const PathQuery& q : queries) {
    if (stop()) break;
    const auto began = Clock::now();
    planning::ShortestPaths paths(map, clearance);
    const planning::ShortestPath found = paths.find(q.start.position, q.goal);
    ms.push_back(spent_ms(began));
    require_solved(found.status == Status::solved);
  }
  return ms;
}

/// Times [ms] of a planner.
std::vector<double> plan_times(const Snapshot& world, const std::vector<PathQuery>& queries,
                               const planning::PlannerParams& params, const Stop& stop) {
  std::vector<double> ms;
  Rng rng(1, Purpose::planner);
  for (const PathQuery& q : queries) {
    if (stop()) break;
    const auto began = Clock::now();
    const Plan made = planning::plan(world, q.start, q.goal, params, rng);
    ms.push_back(spent_ms(began));
    require_solved(made.status == Status::solved);
  }
  return ms;
}

/// Times [ms] of exact queries that find the tangents of those before.
std::vector<double> kept_times(planning::ShortestPaths& paths,
                               const std::vector<PathQuery>& queries, const Stop& stop) {
  std::vector<double> ms;
  for (const bool counts : {false, true})
    for (const PathQuery& q : queries) {
      if (stop()) break;
      const auto began = Clock::now();
      const planning::ShortestPath found = paths.find(q.start.position, q.goal);
      if (counts) ms.push_back(spent_ms(began));
      require_solved(found.status == Status::solved);
    }
  return ms;
}

/// Points of a path, `step` [µm] apart.
std::vector<Vec2> points_along(const std::vector<Vec2>& path, double step) {
  std::vector<Vec2> points{path.front()};
  double left = step;
  for (std::size_t i = 1; i < path.size(); ++i) {
    Vec2 from = path[i - 1];
    for (double d = distance(from, path[i]); d >= left; d = distance(from, path[i])) {
      from += left / d * (path[i] - from);
      points.push_back(from);
      left = step;
    }
    left -= distance(from, path[i]);
  }
  return points;
}

/// Times [ms] of a tree's length queries from these positions, if there is a path.
std::vector<double> tree_times(planning::ShortestPathTree& tree, std::span<const Vec2> positions,
                               const Stop& stop) {
  std::vector<double> ms;
  for (const Vec2 position : positions) {
    if (stop()) break;
    const auto began = Clock::now();
    const bool reaches = tree.length_from(position) < infinity;
    if (reaches) ms.push_back(spent_ms(began));
  }
  require_solved(stop() || 2 * ms.size() > positions.size());
  return ms;
}

/// Paths to the goal of the last query: from places on the way there, one after the other, and,
/// where fields of distances are exact, from the starts of all.
void add_tree_rows(const std::string& where, const Map& map, double clearance,
                   const std::vector<PathQuery>& queries, double aim, const Stop& stop,
                   std::vector<report::BenchRow>& rows) {
  const auto add = [&](const char* what, const char* quantity, double ms,
                       std::optional<double> aimed) {
    rows.push_back({.name = "exact, " + where + ", one goal, " + what,
                    .quantity = quantity,
                    .unit = "ms",
                    .ours = ms,
                    .aim = aimed});
  };
  const PathQuery& last = queries.back();
  const std::vector<Vec2> path =
      planning::ShortestPaths(map, clearance).find(last.start.position, last.goal).points;
  planning::ShortestPathTree on_the_way(map, last.goal, clearance);
  const auto times = tree_times(on_the_way, points_along(path, 0.001 * path_length(path)), stop);
  add("on the way there", "time, median", quantile(times, 0.5), aim);
  add("on the way there", "time, p99", quantile(times, 0.99), {});
  add("on the way there", "time, longest", quantile(times, 1), {});
  if (map.corners().all().size() > planning::DistanceField::max_exact_corners) return;
  std::vector<Vec2> starts;
  starts.reserve(queries.size());
  for (const PathQuery& q : queries) starts.push_back(q.start.position);
  planning::ShortestPathTree all_over(map, last.goal, clearance,
                                      planning::ShortestPathTree::Growth::evenly);
  const auto first = tree_times(all_over, starts, stop);
  add("all over, tree kept", "time, median", quantile(tree_times(all_over, starts, stop), 0.5),
      aim);
  add("all over, growing the tree", "time", std::accumulate(first.begin(), first.end(), 0.0), {});
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

std::vector<report::BenchRow> among_discs_and_polygons(bool quick, const Stop& stop) {
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
  std::vector<report::BenchRow> rows;
  using Aim = std::optional<double>;
  const auto add = [&](const char* name, const std::vector<double>& ours, Aim median, Aim p99) {
    for (report::BenchRow& row :
         time_rows(name, ours, theirs, "OMPL RRTConnect, first path", median, p99))
      rows.push_back(std::move(row));
  };
  world.map().corners();
  add("exact, 140 discs and 70 polygons, no tangents kept",
      anew_times(world.map(), clearance, queries, stop), {}, {});
  planning::ShortestPaths paths(world.map(), clearance);
  add("exact, 140 discs and 70 polygons, tangents kept", kept_times(paths, queries, stop), 0.05,
      0.2);
  rows.push_back({.name = "exact, corners of 140 discs and 70 polygons",
                  .quantity = "time, median",
                  .unit = "ms",
                  .ours = corners_ms(world.map(), 11)});
  add_tree_rows("140 discs and 70 polygons", world.map(), clearance, queries, 0.05, stop, rows);
  return rows;
}

template <class Params>
Params on_grid(double clearance) {
  Params params;
  params.clearance = clearance;
  return params;
}

/// Time and length of a planner whose other values follow from the map.
std::vector<report::BenchRow> fitted_to(const std::string& map, const Snapshot& world,
                                        const std::vector<PathQuery>& queries,
                                        planning::PlannerParams planner,
                                        planning::ShortestPaths& paths, const Stop& stop) {
  planner = planning::fit_to_map(planner, world.map(),
                                 [](std::string_view key) { return key == "clearance_um"; });
  std::vector<double> ms, excess;
  for (const PathQuery& q : queries) {
    if (stop()) break;
    Rng rng(1, Purpose::planner);
    const auto began = Clock::now();
    const Plan made = planning::plan(world, q.start, q.goal, planner, rng, stop);
    ms.push_back(spent_ms(began));
    const planning::ShortestPath best = paths.find(q.start.position, q.goal, stop);
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
std::vector<report::BenchRow> in_grid_map(const std::filesystem::path& file, bool quick,
                                          const Stop& stop) {
  constexpr double cell = 100, clearance = 40;
  const std::string name = file.stem().string();
  const formats::Mask blocked = formats::read_moving_ai(file);
  const auto map = std::make_shared<const Map>(formats::cell_bounds(blocked, cell),
                                               formats::mask_walls(blocked, cell));
  const Snapshot world(map);
  std::vector<PathQuery> queries;
  const auto all = formats::read_scenarios(file.string() + ".scen");
  const std::size_t count = std::min<std::size_t>(all.size(), quick ? 20 : 200);
  for (std::size_t i = 0; i < count; ++i) {
    const formats::GridQuery& q = all[i * all.size() / count];
    queries.push_back({{formats::cell_centre(blocked, q.start.column, q.start.row, cell), 0},
                       formats::cell_centre(blocked, q.goal.column, q.goal.row, cell)});
  }
  std::vector<PathQuery> few;
  for (std::size_t i = 0; i < queries.size(); i += quick ? 5 : 20) few.push_back(queries[i]);
  const planning::AStarParams a_star{{.clearance = clearance, .goal_tolerance = 25, .cell = cell}};
  planning::ShortestPaths paths(*map, clearance);
  std::vector<report::BenchRow> rows{
      {.name = "exact, " + name + ", tangents kept",
       .quantity = "time, median",
       .unit = "ms",
       .ours = quantile(kept_times(paths, queries, stop), 0.5),
       .peer = quantile(plan_times(world, few, a_star, stop), 0.5),
       .peer_name = "our A*, cells of the map",
       .aim = 1},
      {.name = "exact, " + name + ", no tangents kept",
       .quantity = "time, median",
       .unit = "ms",
       .ours = quantile(anew_times(*map, clearance, few, stop), 0.5)},
      {.name = "exact, corners of " + name,
       .quantity = "time, median",
       .unit = "ms",
       .ours = corners_ms(*map, 3),
       .aim = 300}};
  add_tree_rows(name, *map, clearance, few, 1, stop, rows);
  for (const planning::PlannerParams& planner :
       {planning::PlannerParams(on_grid<planning::AStarParams>(clearance)),
        planning::PlannerParams(on_grid<planning::ThetaStarParams>(clearance))})
    for (report::BenchRow& row : fitted_to(name, world, few, planner, paths, stop))
      rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::vector<report::BenchRow> exact_paths(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows = among_discs_and_polygons(quick, stop);
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) return rows;
  for (const char* name :
       {"arena", "den312d", "Berlin_0_256", "32room_000", "random512-10-0", "maze512-32-0"}) {
    const auto file = std::filesystem::path(data) / "grid_maps" / (std::string(name) + ".map");
    if (!std::filesystem::exists(file) || stop()) continue;
    for (report::BenchRow& row : in_grid_map(file, quick, stop)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace microswarm::bench
