// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/grid/a_star.hpp"

#include <cstdlib>
#include <numbers>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/grid/grid.hpp"

namespace microswarm::planning {
namespace {

struct SteppedCell {
  double cost = infinity;
  Mark mark = Mark::unknown;
  std::uint8_t move = 0;  ///< move that led here, or off_grid
};

/// In place of a move: from a start that is no cell of the grid.
constexpr std::uint8_t off_grid = 8;

/// Length of the shortest path on an obstacle-free grid.
double octile(Vec2 d) {
  const double x = std::abs(d.x);
  const double y = std::abs(d.y);
  const auto [least, greatest] = std::minmax(x, y);  // references to both
  return greatest + (std::numbers::sqrt2 - 1) * least;
}

class SteppedSearch : public GridSearch<SteppedSearch, SteppedCell> {
 public:
  using GridSearch::GridSearch;

  bool settle(Place, const SteppedCell&) const { return true; }
  /// With an explicit origin, a node near the target is also joined to it by a straight line.
  std::optional<Place> arrive(Place p) {
    if (is_at_goal(p)) return p;
    const double reach = std::numbers::sqrt2 * params_.cell;
    if (!params_.origin || distance(position(p), target_) > reach || !sees(position(p), target_))
      return std::nullopt;
    end_beyond_ = target_;
    return p;
  }
  Place before(Place p) {
    const std::uint8_t move = grid_[p].move;
    return move == off_grid ? grid_.start() : p - grid_moves[move];
  }

  void join(Place p, SteppedCell& cell) {
    const Vec2 start = position(grid_.start());
    if (sees(start, position(p))) open(p, cell, distance(start, position(p)), off_grid);
  }

  void relax(Place from, const SteppedCell& cell, std::size_t move, SteppedCell& next) {
    const double through = cell.cost + params_.cell * (move % 2 == 0 ? 1 : std::numbers::sqrt2);
    const Place to = from + grid_moves[move];
    if (through < next.cost && neighbour_sees(from, to))
      open(to, next, through, static_cast<std::uint8_t>(move));
  }

 private:
  void open(Place p, SteppedCell& cell, double cost, std::uint8_t move) {
    cell.cost = cost;
    cell.move = move;
    // At least the octile length, of which the tolerance saves at most √(4 - 2√2) · tolerance.
    constexpr double octile_per_length = 1.0823922002923940;
    push(p, cost, octile(goal_ - position(p)) - octile_per_length * params_.goal_tolerance);
  }
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng& rng,
          const Stop& stop) {
  return plan_on_grids(
      world, start, goal, params, rng, stop, [&](const AStarParams& on_grid, Vec2 target) {
        return SteppedSearch(world, start.position, goal, target, on_grid).run(stop);
      });
}

}  // namespace microswarm::planning
