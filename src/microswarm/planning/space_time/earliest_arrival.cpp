// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/earliest_arrival.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/space_time/grid_distances.hpp"

namespace microswarm::planning {
namespace {

/// Greatest ratio of a path over grid_steps to the straight one: lengths divided by it are lower
/// bounds.
constexpr float grid_detour = 1.0276F;

void let_walls_stand(const Map& map, double radius, SpaceTimeGrid& grid) {
  grid.clear_standing();
  for (SpaceTimeGrid::Cell c = 0; c < grid.size(); ++c)
    if (!map.is_free(grid.position(c), radius)) grid.let_stand(c);
}

void occupy_polygon(const Body& body, double radius, int slot, SpaceTimeGrid& grid) {
  const Disc extent = enclosing_disc(body);
  const double reach = extent.radius + radius;
  const auto rows = grid.rows_between(extent.centre.y - reach, extent.centre.y + reach);
  for (int row = rows.begin; row <= rows.end; ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const SpaceTimeGrid::Cell c = grid.at(column, row);
      const Vec2 p = grid.position(c);
      if (!grid.is_free(c, slot) || distance(p, extent.centre) > reach) continue;
      if (distance(p, body) < radius) grid.occupy(c, slot);
    }
}

void occupy_by_obstacles(const World& world, double radius, SpaceTimeGrid& grid, const Stop& stop) {
  grid.clear();
  for (int slot = 0; slot < grid.slots() && !stop(); ++slot) {
    const Snapshot then = world.at((slot + 0.5) * grid.slot());
    for (const Body& body : then.moving().bodies())
      std::visit(Overloaded{[&](const Disc& disc) {
                              grid.occupy({disc.centre, disc.radius + radius}, slot);
                            },
                            [&](const Polygon&) { occupy_polygon(body, radius, slot, grid); }},
                 body.shape);
  }
}

/// Cells in sight of the goal, with the straight lengths to its region.
std::vector<GridDistances::Seed> seeds_at(const Map& map, const ArrivalQuery& query,
                                          const SpaceTimeGrid& grid) {
  std::vector<GridDistances::Seed> seeds;
  const GoalArea goal_area(map, query.goal, query.tolerance);
  const double near = std::max(query.tolerance, 1.5 * grid.cell());
  for (SpaceTimeGrid::Cell c = 0; c < grid.size(); ++c) {
    const Vec2 p = grid.position(c);
    const double away = distance(p, query.goal);
    if (away > near || grid.stands(c)) continue;
    if (away > query.tolerance ? !map.is_free(Segment{p, query.goal}, query.radius)
                               : !goal_area.contains(p))
      continue;
    seeds.push_back({c, std::max(0.0, away - query.tolerance)});
  }
  return seeds;
}

/// Cells around the start that are in sight.
std::vector<SpaceTimeGrid::Cell> entries_at(const Map& map, const ArrivalQuery& query,
                                            const SpaceTimeGrid& grid) {
  constexpr int reach = 3;  // [cells]
  std::vector<SpaceTimeGrid::Cell> entries;
  constexpr double rounding = 1e-9;
  const double keep = std::min(query.radius, (1 - rounding) * map.clearance(query.start));
  const SpaceTimeGrid::Cell here = grid.nearest(query.start);
  for (int j = -reach; j <= reach; ++j)
    for (int i = -reach; i <= reach; ++i) {
      const int column = grid.column_of(here) + i;
      const int row = grid.row_of(here) + j;
      if (!grid.holds(column, row) || grid.stands(grid.at(column, row))) continue;
      const SpaceTimeGrid::Cell c = grid.at(column, row);
      if (map.is_free(Segment{query.start, grid.position(c)}, keep)) entries.push_back(c);
    }
  return entries;
}

/// Time for which the swarm can wait at its start [s]; beside a wall, for all of it.
double stay_at(const SpaceTimeGrid& grid, Vec2 start) {
  const SpaceTimeGrid::Cell here = grid.nearest(start);
  if (grid.stands(here)) return grid.horizon();
  const auto safe = grid.safe_interval(here, 0);
  if (safe.begin != 0) return 0;
  return safe.end == SpaceTimeGrid::forever ? grid.horizon() : safe.end * grid.slot();
}

}  // namespace

EarliestArrival earliest_arrival(const World& world, const ArrivalQuery& query, const Stop& stop) {
  EarliestArrival out;
  if (GoalArea(*world.map, query.goal, query.tolerance).contains(query.start)) {
    out = {Status::solved, 0, {{query.start, 0}}};
    return out;
  }
  const int slots = std::max(1, static_cast<int>(std::ceil(query.horizon / query.slot)));
  SpaceTimeGrid grid(world.map->bounds(), query.cell, query.slot, slots);
  let_walls_stand(*world.map, query.radius, grid);
  occupy_by_obstacles(world, query.radius + query.gap, grid, stop);
  const auto seeds = seeds_at(*world.map, query, grid);
  GridDistances to_go;
  to_go.compute(grid, seeds);
  std::vector<float> lengths(to_go.lengths().begin(), to_go.lengths().end());
  double arrived = 0;
  for (float& length : lengths) length /= grid_detour;
  for (const auto& seed : seeds) {
    lengths[seed.cell] = static_cast<float>(seed.length);
    arrived = std::max(arrived, seed.length);
  }
  const auto entries = entries_at(*world.map, query, grid);
  SafeIntervalSearch search;
  out.status = search.find(grid,
                           {.from = query.start,
                            .stay_until = stay_at(grid, query.start),
                            .entries = entries,
                            .speed = query.speed,
                            .lengths = lengths,
                            .arrived = arrived},
                           stop);
  if (stop()) out.status = stop.status().value_or(out.status);
  out.time = search.arrival();
  out.path.assign(search.path().begin(), search.path().end());
  return out;
}

}  // namespace microswarm::planning
