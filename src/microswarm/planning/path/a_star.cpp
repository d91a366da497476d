// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/a_star.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <queue>

#include "microswarm/planning/common/free_goal.hpp"

namespace microswarm {
namespace {

/// Grid position, in cells from the lower left corner.
struct Place {
  int column = 0;
  int row = 0;
  friend constexpr bool operator==(Place, Place) = default;
};
constexpr Place operator+(Place a, Place b) { return {a.column + b.column, a.row + b.row}; }
constexpr Place operator-(Place a, Place b) { return {a.column - b.column, a.row - b.row}; }

/// Straight moves have even indices; a diagonal lies between its two.
constexpr std::array<Place, 8> grid_moves{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

enum class Mark : std::uint8_t { unknown, blocked, free, closed };

struct Cell {
  double cost = std::numeric_limits<double>::infinity();
  Mark mark = Mark::unknown;
  std::uint8_t move = 0;  ///< move that led here
};

/// Grid cells in tiles that are allocated on first use.
class Grid {
 public:
  static constexpr std::size_t side = 64;
  static constexpr double max_tiles = 1 << 22;

  Grid(const Box& bounds, Vec2 origin, double cell) : cell_(cell), origin_(origin) {
    const auto places = [&](double length) { return std::floor(std::max(0.0, length) / cell); };
    const double left = places(origin.x - bounds.lo.x);
    const double below = places(origin.y - bounds.lo.y);
    const double columns = left + places(bounds.hi.x - origin.x) + 1;
    const double rows = below + places(bounds.hi.y - origin.y) + 1;
    fits_ = std::max({columns, rows, (columns / side + 1) * (rows / side + 1)}) < max_tiles;
    if (!fits_) return;
    start_ = {static_cast<int>(left), static_cast<int>(below)};
    columns_ = static_cast<int>(columns);
    rows_ = static_cast<int>(rows);
    tile_columns_ = static_cast<std::size_t>(columns_) / side + 1;
    tiles_.resize(tile_columns_ * (static_cast<std::size_t>(rows_) / side + 1));
  }

  /// Whether the directory of tiles has a reasonable size.
  bool fits() const { return fits_; }
  Place start() const { return start_; }
  bool holds(Place p) const {
    return p.column >= 0 && p.row >= 0 && p.column < columns_ && p.row < rows_;
  }
  Vec2 position(Place p) const {
    const Place d = p - start_;
    return origin_ + cell_ * Vec2{static_cast<double>(d.column), static_cast<double>(d.row)};
  }
  Cell& operator[](Place p) {
    const auto row = static_cast<std::size_t>(p.row);
    const auto column = static_cast<std::size_t>(p.column);
    auto& tile = tiles_[row / side * tile_columns_ + column / side];
    if (!tile) tile = std::make_unique<std::array<Cell, side * side>>();
    return (*tile)[row % side * side + column % side];
  }

 private:
  double cell_;
  Vec2 origin_;
  bool fits_ = false;
  Place start_;
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
  Place place;
  friend bool operator<(const OpenPlace& a, const OpenPlace& b) {
    if (a.estimate != b.estimate) return a.estimate > b.estimate;
    if (a.cost != b.cost) return a.cost < b.cost;
    if (a.place.row != b.place.row) return a.place.row > b.place.row;
    return a.place.column > b.place.column;
  }
};

/// Length of the shortest path on an obstacle-free grid.
double octile(Vec2 d) {
  const double x = std::abs(d.x);
  const double y = std::abs(d.y);
  const auto [least, greatest] = std::minmax(x, y);  // references to both
  return greatest + (std::numbers::sqrt2 - 1) * least;
}

class Search {
 public:
  Search(const Snapshot& world, Vec2 start, Vec2 goal, const AStarParams& params)
      : world_(world), goal_(goal), params_(params), grid_(world.bounds(), start, params.cell) {}

  Plan run(const Stop& stop) {
    if (!grid_.fits()) return finish(Status::node_limit, grid_.start());
    Place best = grid_.start();
    grid_[best].cost = 0;
    open_.push({0, 0, best});
    while (!open_.empty()) {
      const auto [_, cost, place] = open_.top();
      open_.pop();
      Cell& cell = grid_[place];
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
      open_neighbours(place, cost);
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

  /// Cell at `p` if it is free and not closed, else null. `free` tells whether it is free.
  Cell* open_cell(Place p, bool& free) {
    free = false;
    if (!grid_.holds(p)) return nullptr;
    Cell& cell = grid_[p];
    if (cell.mark == Mark::unknown) {
      ++counts_.samples;
      cell.mark = world_.is_free(grid_.position(p), params_.clearance) ? Mark::free : Mark::blocked;
    }
    free = cell.mark != Mark::blocked;
    return cell.mark == Mark::free ? &cell : nullptr;
  }

  void open_neighbours(Place place, double cost) {
    std::array<Cell*, 8> cells{};
    std::array<bool, 8> free{};
    for (std::size_t i = 0; i < 8; i += 2) cells[i] = open_cell(place + grid_moves[i], free[i]);
    for (std::size_t i = 1; i < 8; i += 2) {
      if (free[i - 1] && free[(i + 1) % 8]) cells[i] = open_cell(place + grid_moves[i], free[i]);
    }
    for (std::size_t i = 0; i < 8; ++i) {
      if (cells[i]) relax(place, cost, i, *cells[i]);
    }
  }

  void relax(Place from, double cost, std::size_t move, Cell& cell) {
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
  Grid grid_;
  std::priority_queue<OpenPlace> open_;
  PlanCounts counts_;
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng&,
          const Stop& stop) {
  if (const auto fault =
          query_fault(world, start.position, goal, params.goal_tolerance, params.clearance)) {
    Plan blocked;
    blocked.status = *fault;
    blocked.path.push_back(start.position);
    return blocked;
  }
  return Search(world, start.position, goal, params).run(stop);
}

}  // namespace microswarm
