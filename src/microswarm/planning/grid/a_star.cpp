// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/grid/a_star.hpp"

#include <cstdlib>
#include <numbers>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/grid/grid.hpp"

namespace microswarm {
namespace {

struct SteppedCell {
  double cost = infinity;
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

class SteppedSearch : public GridSearch<SteppedSearch, SteppedCell> {
 public:
  using GridSearch::GridSearch;

  bool settle(Place, const SteppedCell&) const { return true; }
  std::optional<Place> arrive(Place p) const {
    return is_at_goal(p) ? std::optional(p) : std::nullopt;
  }
  Place before(Place p) { return p - grid_moves[grid_[p].move]; }

  void relax(Place from, const SteppedCell& cell, std::size_t move, SteppedCell& next) {
    const double through = cell.cost + params_.cell * (move % 2 == 0 ? 1 : std::numbers::sqrt2);
    const Place to = from + grid_moves[move];
    if (through >= next.cost || !sees(position(from), position(to))) return;
    next.cost = through;
    next.move = static_cast<std::uint8_t>(move);
    // At least the octile length, of which the tolerance saves at most √(4 - 2√2) · tolerance.
    constexpr double octile_per_length = 1.0823922002923940;
    push(to, through, octile(goal_ - position(to)) - octile_per_length * params_.goal_tolerance);
  }
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng& rng,
          const Stop& stop) {
  return plan_on_grids(world, start, goal, params, rng, stop,
                       [&](const AStarParams& on_grid, Vec2) {
                         return SteppedSearch(world, start.position, goal, on_grid).run(stop);
                       });
}

}  // namespace microswarm
