// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/theta_star.hpp"

#include <limits>
#include <queue>

#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/path/grid.hpp"

namespace microswarm {
namespace {

struct SeenCell {
  double cost = std::numeric_limits<double>::infinity();
  Place parent;
  Mark mark = Mark::unknown;
};

/// Every cell takes its parent's parent for its own, in the hope that they see each other, which is
/// tested when the cell is opened.
class AnyAngleSearch {
 public:
  AnyAngleSearch(const Snapshot& world, Vec2 start, Vec2 goal, Vec2 target,
                 const ThetaStarParams& params)
      : world_(world),
        goal_(goal),
        target_(target),
        params_(params),
        grid_(world.bounds(), start, params.cell) {}

  Plan run(const Stop& stop) {
    if (!grid_.fits()) return finish(Status::node_limit, grid_.start());
    Place best = grid_.start();
    grid_[best].cost = 0;
    grid_[best].parent = best;
    open_.push({0, 0, best});
    while (!open_.empty()) {
      const auto [_, cost, place] = open_.top();
      open_.pop();
      SeenCell& cell = grid_[place];
      if (cell.mark == Mark::closed || cost != cell.cost) continue;
      if (counts_.iterations % 64 == 0)
        if (const auto told = stop.status()) return finish(*told, best);
      if (counts_.iterations >= static_cast<std::uint64_t>(params_.max_nodes))
        return finish(Status::node_limit, best);
      ++counts_.iterations;
      if (!join_parent(place, cell)) continue;
      cell.mark = Mark::closed;
      const double left = distance(grid_.position(place), goal_);
      if (left < distance(grid_.position(best), goal_)) best = place;
      if (left <= params_.goal_tolerance) return finish(Status::solved, place);
      if (left <= 2 * params_.cell + params_.goal_tolerance && sees(place, target_))
        return finish(Status::solved, place, &target_);
      open_neighbours(place, cell);
    }
    return finish(Status::no_path, best);
  }

 private:
  /// In 2⁻³⁰ cells.
  std::int64_t estimate(Place p, double cost) const {
    const double left = distance(grid_.position(p), goal_) - params_.goal_tolerance;
    return std::llround((cost + std::max(0.0, left)) / params_.cell * 0x1p30);
  }

  bool sees(Place from, Vec2 to) {
    ++counts_.edge_checks;
    return world_.is_free(Segment{grid_.position(from), to}, params_.clearance);
  }

  bool is_free(Vec2 p) {
    ++counts_.samples;
    return world_.is_free(p, params_.clearance);
  }

  /// Gives a cell that does not see its parent the best neighbour that is closed; false if it now
  /// has to wait, since others come before it, or sees none.
  bool join_parent(Place place, SeenCell& cell) {
    if (place == grid_.start() || sees(cell.parent, grid_.position(place))) return true;
    const double hoped = cell.cost;
    cell.cost = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grid_moves.size(); ++i) {
      const Place p = place + grid_moves[i];
      if (!grid_.holds(p) || grid_[p].mark != Mark::closed) continue;
      const double cost = grid_[p].cost + grid_.cell() * (i % 2 == 0 ? 1 : std::sqrt(2.0));
      if (cost >= cell.cost || !sees(p, grid_.position(place))) continue;
      cell.cost = cost;
      cell.parent = p;
    }
    if (cell.cost == std::numeric_limits<double>::infinity()) return false;
    // A path that is longer than hoped for waits for its turn.
    if (cell.cost <= hoped) return true;
    open_.push({estimate(place, cell.cost), cell.cost, place});
    return false;
  }

  void open_neighbours(Place place, const SeenCell& cell) {
    const Place parent = cell.parent;
    const Vec2 from = grid_.position(parent);
    const double cost = grid_[parent].cost;
    grid_.for_each_open_neighbour(
        place, [this](Vec2 p) { return is_free(p); },
        [&](std::size_t move, SeenCell& next) {
          const Place to = place + grid_moves[move];
          const double through = cost + distance(from, grid_.position(to));
          if (through >= next.cost) return;
          next.cost = through;
          next.parent = parent;
          open_.push({estimate(to, through), through, to});
        });
  }

  /// The path to `last`, and straight on to `end` if it is given.
  Plan finish(Status status, Place last, const Vec2* end = nullptr) {
    Plan plan;
    plan.status = status;
    plan.counts = counts_;
    if (end) plan.path.push_back(*end);
    if (end && last != grid_.start() && sees(grid_[last].parent, *end)) last = grid_[last].parent;
    for (Place p = last; p != grid_.start(); p = grid_[p].parent)
      plan.path.push_back(grid_.position(p));
    plan.path.push_back(grid_.position(grid_.start()));
    std::reverse(plan.path.begin(), plan.path.end());
    return plan;
  }

  const Snapshot& world_;
  Vec2 goal_;
  Vec2 target_;  ///< a free place at the goal
  const ThetaStarParams& params_;
  Grid<SeenCell> grid_;
  std::priority_queue<OpenPlace> open_;
  PlanCounts counts_;
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ThetaStarParams& params, Rng& rng,
          const Stop& stop) {
  if (const auto fault =
          query_fault(world, start.position, goal, params.goal_tolerance, params.clearance)) {
    Plan blocked;
    blocked.status = *fault;
    blocked.path.push_back(start.position);
    return blocked;
  }
  const Vec2 target = *free_goal(world, goal, params.goal_tolerance, params.clearance);
  return plan_on_grids(world, start, goal, params, rng, stop, [&](const ThetaStarParams& on_grid) {
    return AnyAngleSearch(world, start.position, goal, target, on_grid).run(stop);
  });
}

}  // namespace microswarm
