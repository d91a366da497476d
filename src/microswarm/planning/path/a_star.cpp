// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/a_star.hpp"

#include <cstdlib>
#include <limits>
#include <numbers>
#include <queue>

#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/path/grid.hpp"

namespace microswarm {
namespace {

struct SteppedCell {
  double cost = std::numeric_limits<double>::infinity();
  Mark mark = Mark::unknown;
  std::uint8_t move = 0;  ///< move that led here
};

/// Length of the shortest path on an obstacle-free grid.
double octile(Vec2 d) {
  const double x = std::abs(d.x);
  const double y = std::abs(d.y);
  const auto [least, greatest] = std::minmax(x, y);  // references to both
  return greatest + (std::numbers::sqrt2 - 1) * least;
}

class SteppedSearch {
 public:
  SteppedSearch(const Snapshot& world, Vec2 start, Vec2 goal, const AStarParams& params)
      : world_(world), goal_(goal), params_(params), grid_(world.bounds(), start, params.cell) {}

  Plan run(const Stop& stop) {
    if (!grid_.fits()) return finish(Status::node_limit, grid_.start());
    Place best = grid_.start();
    grid_[best].cost = 0;
    open_.push({0, 0, best});
    while (!open_.empty()) {
      const Place place = open_.top().place;
      const double cost = open_.top().cost;
      open_.pop();
      SteppedCell& cell = grid_[place];
      if (cell.mark == Mark::closed) continue;
      if (counts_.iterations % 64 == 0)
        if (const auto told = stop.status()) return finish(*told, best);
      if (counts_.iterations >= static_cast<std::uint64_t>(params_.max_nodes)) {
        return finish(Status::node_limit, best);
      }
      ++counts_.iterations;
      cell.mark = Mark::closed;
      if (to_goal(place) < to_goal(best)) best = place;
      if (to_goal(place) <= params_.goal_tolerance) return finish(Status::solved, place);
      grid_.for_each_open_neighbour(
          place, [this](Vec2 p) { return is_free(p); },
          [&](std::size_t move, SteppedCell& next) { relax(place, cost, move, next); });
    }
    return finish(Status::no_path, best);
  }

 private:
  double to_goal(Place p) const { return distance(grid_.position(p), goal_); }

  /// Lower bound of the length of a path through `p`. The remaining length is at least the octile
  /// length to the goal, of which the tolerance saves at most √(4 - 2√2) · tolerance.
  std::int64_t estimate(Place p, double cost) const {
    constexpr double octile_per_length = 1.0823922002923940;
    const double left =
        octile(goal_ - grid_.position(p)) - octile_per_length * params_.goal_tolerance;
    return std::llround((cost + std::max(0.0, left)) / params_.cell * 0x1p30);
  }

  bool is_free(Vec2 p) {
    ++counts_.samples;
    return world_.is_free(p, params_.clearance);
  }

  void relax(Place from, double cost, std::size_t move, SteppedCell& cell) {
    const double through = cost + params_.cell * (move % 2 == 0 ? 1 : std::numbers::sqrt2);
    if (through >= cell.cost) return;
    ++counts_.edge_checks;
    const Place to = from + grid_moves[move];
    if (!world_.is_free(Segment{grid_.position(from), grid_.position(to)}, params_.clearance)) {
      return;
    }
    cell.cost = through;
    cell.move = static_cast<std::uint8_t>(move);
    open_.push({estimate(to, through), through, to});
  }

  Plan finish(Status status, Place last) {
    Plan plan;
    plan.status = status;
    plan.counts = counts_;
    for (Place p = last; p != grid_.start(); p = p - grid_moves[grid_[p].move]) {
      plan.path.push_back(grid_.position(p));
    }
    plan.path.push_back(grid_.position(grid_.start()));
    std::reverse(plan.path.begin(), plan.path.end());
    return plan;
  }

  const Snapshot& world_;
  Vec2 goal_;
  const AStarParams& params_;
  Grid<SteppedCell> grid_;
  std::priority_queue<OpenPlace> open_;
  PlanCounts counts_;
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng& rng,
          const Stop& stop) {
  if (const auto fault =
          query_fault(world, start.position, goal, params.goal_tolerance, params.clearance)) {
    Plan blocked;
    blocked.status = *fault;
    blocked.path.push_back(start.position);
    return blocked;
  }
  return plan_on_grids(world, start, goal, params, rng, stop, [&](const AStarParams& on_grid) {
    return SteppedSearch(world, start.position, goal, on_grid).run(stop);
  });
}

}  // namespace microswarm
