// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <queue>
#include <vector>

#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/exact/exact.hpp"
#include "microswarm/planning/grid/grid_params.hpp"

namespace microswarm::planning {

/// Grid position, in cells from the lower left corner.
struct Place {
  int column = 0;
  int row = 0;
  friend constexpr bool operator==(Place, Place) = default;
};
constexpr Place operator+(Place a, Place b) { return {a.column + b.column, a.row + b.row}; }
constexpr Place operator-(Place a, Place b) { return {a.column - b.column, a.row - b.row}; }

/// Straight moves have even indices; a diagonal lies between its two.
inline constexpr std::array<Place, 8> grid_moves{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Knowledge about a cell's position.
enum class Mark : std::uint8_t { unknown, blocked, free, closed };

/// Grid cells in tiles that are allocated on first use. One more cell stands for a start that is
/// none of its places.
template <class Cell>
class Grid {
 public:
  static constexpr std::size_t side = 64;
  static constexpr double max_tiles = 1 << 22;

  /// `origin` is a cell of the grid, in the bounds or not; without one the start is.
  Grid(const Box& bounds, Vec2 start, std::optional<Vec2> origin, double cell)
      : cell_(cell), start_at_(start), origin_(origin.value_or(start)) {
    const auto places = [&](double length) { return std::floor(length / cell); };
    const double left = places(origin_.x - bounds.lo.x);
    const double below = places(origin_.y - bounds.lo.y);
    const double columns = left + places(bounds.hi.x - origin_.x) + 1;
    const double rows = below + places(bounds.hi.y - origin_.y) + 1;
    fits_ = std::max({std::abs(left), std::abs(below), columns, rows,
                      (columns / side + 1) * (rows / side + 1)}) < max_tiles;
    if (!fits_) return;
    origin_place_ = {static_cast<int>(left), static_cast<int>(below)};
    columns_ = static_cast<int>(std::max(0.0, columns));
    rows_ = static_cast<int>(std::max(0.0, rows));
    start_ = origin ? Place{columns_, 0} : origin_place_;
    tile_columns_ = static_cast<std::size_t>(columns_) / side + 1;
    tiles_.resize(tile_columns_ * (static_cast<std::size_t>(rows_) / side + 1));
  }

  /// Whether the directory of tiles has a reasonable size.
  bool fits() const { return fits_; }
  /// Spacing of the grid [µm].
  double cell() const { return cell_; }
  Place start() const { return start_; }
  bool holds(Place p) const {
    return p.column >= 0 && p.row >= 0 && p.column < columns_ && p.row < rows_;
  }
  /// Position [µm] of a cell of the grid.
  Vec2 operator()(Place p) const {
    const Place d = p - origin_place_;
    return origin_ + cell_ * Vec2{static_cast<double>(d.column), static_cast<double>(d.row)};
  }
  /// The same also for the start.
  Vec2 position(Place p) const { return p == start_ ? start_at_ : (*this)(p); }
  Cell& operator[](Place p) {
    const auto row = static_cast<std::size_t>(p.row);
    const auto column = static_cast<std::size_t>(p.column);
    auto& tile = tiles_[row / side * tile_columns_ + column / side];
    if (!tile) tile = std::make_unique<std::array<Cell, side * side>>();
    return (*tile)[row % side * side + column % side];
  }

  /// Calls use(place) for the up to 16 places around a position, two on each side per axis.
  template <class Use>
  void for_each_around(Vec2 p, Use&& use) const {
    const Vec2 from = (p - origin_) / cell_;
    const Place low = origin_place_ + Place{static_cast<int>(std::floor(from.x)) - 1,
                                            static_cast<int>(std::floor(from.y)) - 1};
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        if (const Place near = low + Place{column, row}; holds(near)) use(near);
  }

  /// Calls use(move, cell) for each neighbour that is free and not closed, without cutting corners.
  /// `is_free` tests a position [µm] that is asked for the first time.
  template <class IsFree, class Use>
  void for_each_open_neighbour(Place place, IsFree&& is_free, Use&& use) {
    std::array<Cell*, 8> cells{};
    std::array<bool, 8> free{};
    const auto open = [&](std::size_t move) {
      const Place p = place + grid_moves[move];
      if (!holds(p)) return;
      Cell& cell = (*this)[p];
      if (cell.mark == Mark::unknown) cell.mark = is_free(position(p)) ? Mark::free : Mark::blocked;
      free[move] = cell.mark != Mark::blocked;
      if (cell.mark == Mark::free) cells[move] = &cell;
    };
    for (std::size_t i = 0; i < 8; i += 2) open(i);
    for (std::size_t i = 1; i < 8; i += 2)
      if (free[i - 1] && free[(i + 1) % 8]) open(i);
    for (std::size_t i = 0; i < 8; ++i)
      if (cells[i]) use(i, *cells[i]);
  }

 private:
  double cell_;
  Vec2 start_at_;
  Vec2 origin_;
  bool fits_ = false;
  Place start_;
  Place origin_place_;
  int columns_ = 0;
  int rows_ = 0;
  std::size_t tile_columns_ = 0;
  std::vector<std::unique_ptr<std::array<Cell, side * side>>> tiles_;
};

/// Entry of the open list: minimum estimate first, then farthest from the start, then lower left.
/// Estimates are integer multiples of 2⁻³⁰ cells, so that rounding does not distinguish paths of
/// equal length across open space.
struct OpenPlace {
  std::int64_t estimate;
  double cost;
  Place place{};
  friend bool operator<(const OpenPlace& a, const OpenPlace& b) {
    if (a.estimate != b.estimate) return a.estimate > b.estimate;
    if (a.cost != b.cost) return a.cost < b.cost;
    if (a.place.row != b.place.row) return a.place.row > b.place.row;
    return a.place.column > b.place.column;
  }
};

/// Best-first search over a grid. A Rule derives from it and says what a cell costs:
///   void join(Place, Cell&)  opens a place around a start that is off the grid, or not
///   void relax(Place from, const Cell&, std::size_t move, Cell& next)  opens a neighbour, or not
///   bool settle(Place, Cell&)  false: the cell cannot be closed yet
///   std::optional<Place> arrive(Place)  last place of the path if a closed one ends the search;
///                                       it may set end_beyond_, which then follows
///   Place before(Place)        the place before on the path
/// `Cell` has a cost, infinite at first, and a mark.
template <class Rule, class Cell>
class GridSearch {
 public:
  /// `target` is a free place at the goal.
  GridSearch(const Snapshot& world, Vec2 start, Vec2 goal, Vec2 target, const GridParams& params)
      : world_(world),
        goal_(goal),
        goal_area_(world.map(), goal, params.goal_tolerance),
        target_(target),
        params_(params),
        grid_(world.bounds(), start, params.origin, params.cell) {}

  Plan run(const Stop& stop) {
    if (!grid_.fits()) return finish(Status::node_limit, grid_.start());
    Place best = grid_.start();
    grid_[best].cost = 0;
    push(best, 0, 0);
    while (!open_.empty()) {
      const Place place = open_.top().place;
      const double cost = open_.top().cost;
      open_.pop();
      Cell& cell = grid_[place];
      if (cell.mark == Mark::closed || cost != cell.cost) continue;
      if (counts_.iterations % 64 == 0)
        if (const auto told = stop.status()) return finish(*told, best);
      if (counts_.iterations >= static_cast<std::uint64_t>(params_.max_nodes))
        return finish(Status::node_limit, best);
      ++counts_.iterations;
      if (!rule().settle(place, cell)) continue;
      cell.mark = Mark::closed;
      if (to_goal(place) < to_goal(best)) best = place;
      if (const auto last = rule().arrive(place)) return finish(Status::solved, *last);
      if (place == grid_.start() && params_.origin)
        join_start();
      else
        open_neighbours(place, cell);
    }
    return finish(Status::no_path, best);
  }

 protected:
  Vec2 position(Place p) const { return grid_.position(p); }
  double to_goal(Place p) const { return distance(position(p), goal_); }
  bool is_at_goal(Place p) const { return goal_area_.contains(position(p)); }
  /// Opens a place at this cost, from which at least `left` remains [µm].
  void push(Place p, double cost, double left) {
    const double length = cost + std::max(0.0, left);
    open_.push({std::llround(length / params_.cell * 0x1p30), cost, p});
  }
  /// Whether the edge from the place that is being closed to its neighbour is free.
  bool neighbour_sees(Place from, Place to) {
    return all_around_is_free_ || sees(position(from), position(to));
  }
  bool sees(Vec2 from, Vec2 to) {
    ++counts_.edge_checks;
    return world_.is_free(Segment{from, to}, params_.clearance);
  }

  const Snapshot& world_;
  Vec2 goal_;
  GoalArea goal_area_;
  Vec2 target_;
  const GridParams& params_;
  Grid<Cell> grid_;
  std::optional<Vec2> end_beyond_;

 private:
  Rule& rule() { return static_cast<Rule&>(*this); }

  bool is_free(Vec2 p) {
    ++counts_.samples;
    return world_.is_free(p, params_.clearance);
  }

  void join_start() {
    grid_.for_each_around(position(grid_.start()), [this](Place p) {
      Cell& cell = grid_[p];
      cell.mark = is_free(position(p)) ? Mark::free : Mark::blocked;
      if (cell.mark == Mark::free) rule().join(p, cell);
    });
  }

  void open_neighbours(Place place, const Cell& cell) {
    constexpr double reach = std::numbers::sqrt2 * (1 + 1e-9);  // of the edges, in cells
    all_around_is_free_ = world_.is_open(position(place), params_.clearance + reach * grid_.cell());
    grid_.for_each_open_neighbour(
        place, [this](Vec2 p) { return all_around_is_free_ || is_free(p); },
        [&](std::size_t move, Cell& next) { rule().relax(place, cell, move, next); });
  }

  Plan finish(Status status, Place last) {
    Plan plan{.status = status, .counts = counts_};
    if (end_beyond_) plan.path.push_back(*end_beyond_);
    for (; last != grid_.start(); last = rule().before(last)) plan.path.push_back(position(last));
    plan.path.push_back(position(grid_.start()));
    std::reverse(plan.path.begin(), plan.path.end());
    return plan;
  }

  std::priority_queue<OpenPlace> open_;
  bool all_around_is_free_ = false;  ///< of the place that is being closed, and the edges there
  PlanCounts counts_;
};

/// Plan by `search(params, target)` on successively finer grids, see GridParams; `target` is a free
/// position at the goal. `search` returns no_path for a grid without a path.
template <class Params, class Search>
Plan plan_on_grids(const Snapshot& world, Pose2 start, Vec2 goal, Params params, Rng& rng,
                   const Stop& stop, Search&& search) {
  const Target target =
      find_target(world, start.position, goal, params.goal_tolerance, params.clearance);
  if (target.fault) return target.blocked(start.position);
  PlanCounts before;
  for (bool is_first = true;; is_first = false) {
    Plan plan = search(params, target.position);
    plan.counts += before;
    if (plan.status != Status::no_path) return plan;
    if (is_first) {
      const ExactParams proof{.clearance = params.clearance,
                              .goal_tolerance = params.goal_tolerance};
      const Status status = microswarm::planning::plan(world, start, goal, proof, rng, stop).status;
      if (status != Status::solved) {
        plan.status = status;
        return plan;
      }
    }
    const auto opened = plan.counts.iterations - before.iterations;
    before = plan.counts;
    params.max_nodes -= static_cast<int>(opened);
    params.cell /= 2;
    if (params.max_nodes > 0) continue;
    plan.status = Status::node_limit;
    return plan;
  }
}

}  // namespace microswarm::planning
