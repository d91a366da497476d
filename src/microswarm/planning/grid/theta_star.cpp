// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/grid/theta_star.hpp"

#include <numbers>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/grid/grid.hpp"

namespace microswarm::planning {
namespace {

struct SeenCell {
  double cost = infinity;
  Place parent;
  Mark mark = Mark::unknown;
};

/// Every cell takes its parent's parent for its own, in the hope that they see each other, which is
/// tested when the cell is opened.
class AnyAngleSearch : public GridSearch<AnyAngleSearch, SeenCell> {
 public:
  AnyAngleSearch(const Snapshot& world, Vec2 start, Vec2 goal, Vec2 target,
                 const ThetaStarParams& params)
      : GridSearch(world, start, goal, target, params) {
    if (grid_.fits()) grid_[grid_.start()].parent = grid_.start();
  }

  Place before(Place p) { return grid_[p].parent; }

  /// Gives a cell that does not see its parent the best neighbour that is closed; false if it now
  /// has to wait, since others come before it, or sees none.
  bool settle(Place place, SeenCell& cell) {
    if (place == grid_.start() || sees(position(cell.parent), position(place))) return true;
    const double hoped = cell.cost;
    cell.cost = infinity;
    for (std::size_t i = 0; i < grid_moves.size(); ++i) {
      const Place p = place + grid_moves[i];
      if (!grid_.holds(p) || grid_[p].mark != Mark::closed) continue;
      const double cost = grid_[p].cost + grid_.cell() * (i % 2 == 0 ? 1 : std::numbers::sqrt2);
      if (cost >= cell.cost || !sees(position(p), position(place))) continue;
      cell.cost = cost;
      cell.parent = p;
    }
    if (cell.cost == infinity) return false;
    if (cell.cost > hoped) open(place, cell.cost);
    return cell.cost <= hoped;
  }

  void join(Place p, SeenCell& cell) {
    cell.cost = distance(position(grid_.start()), position(p));
    cell.parent = grid_.start();
    open(p, cell.cost);
  }

  void relax(Place place, const SeenCell& cell, std::size_t move, SeenCell& next) {
    const Place to = place + grid_moves[move];
    const double through = grid_[cell.parent].cost + distance(position(cell.parent), position(to));
    if (through >= next.cost) return;
    next.cost = through;
    next.parent = cell.parent;
    open(to, through);
  }

  /// Near the goal also straight on to the target, from the cell or from its parent.
  std::optional<Place> arrive(Place p) {
    if (is_at_goal(p)) return p;
    if (to_goal(p) > 2 * params_.cell + params_.goal_tolerance || !sees(position(p), target_))
      return std::nullopt;
    end_beyond_ = target_;
    const Place parent = grid_[p].parent;
    return sees(position(parent), target_) ? parent : p;
  }

 private:
  void open(Place p, double cost) { push(p, cost, to_goal(p) - params_.goal_tolerance); }
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const ThetaStarParams& params, Rng& rng,
          const Stop& stop) {
  return plan_on_grids(
      world, start, goal, params, rng, stop, [&](const ThetaStarParams& on_grid, Vec2 target) {
        return AnyAngleSearch(world, start.position, goal, target, on_grid).run(stop);
      });
}

}  // namespace microswarm::planning
