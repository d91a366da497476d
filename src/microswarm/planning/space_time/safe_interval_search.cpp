// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/safe_interval_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/space_time/grid_distances.hpp"

namespace microswarm::planning {
namespace {

/// Difference of times that does not count [s].
constexpr double time_rounding = 1e-9;

}  // namespace

/// Cost of the turn from the query's heading into the direction `course`: proportional to small
/// angles, and to the chord of large ones [s].
double SafeIntervalSearch::cost_of_turn(const Query& query, Vec2 course) const {
  const double length = norm(course);
  if (!query.heading || length == 0) return 0;
  const double cosine = dot(course, ahead_) / length;
  return query.turn_cost * std::sqrt(std::max(0.0, 2 * (1 - cosine)));
}

/// Time for which the swarm turns at a state before it moves on in the direction `course` [s].
double SafeIntervalSearch::turn_delay(const Query& query, const State& from, Vec2 course) const {
  if (!std::isfinite(query.turning.turn_rate)) return 0;
  if (squared_norm(course) == 0) return 0;
  const Vec2 moved = from.parent == none ? Vec2{} : from.position - states_[from.parent].position;
  const bool has_moved = squared_norm(moved) > 0;
  if (!has_moved && !query.heading) return 0;
  const Vec2 before = has_moved ? moved : ahead_;
  return query.turning.delay(turn_between(heading_along(before), heading_along(course)));
}

void SafeIntervalSearch::reserve(const SpaceTimeGrid& grid, std::size_t states) {
  states_.reserve(states);
  open_.reserve(2 * states);
  path_.reserve(grid.size());
  first_.resize(grid.size());
  search_.resize(grid.size());
}

Status SafeIntervalSearch::find(const SpaceTimeGrid& grid, const Query& query, const Stop& stop) {
  begin(grid, query);
  std::uint32_t nearest = 0;
  float least = std::numeric_limits<float>::infinity();
  while (!open_.empty()) {
    const auto [cost, number, next] = open_.front();
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    if (next == Next::test_shortcut) {
      test_shortcut(grid, query, number);
      continue;
    }
    if (next == Next::stay_to_horizon) {
      finish(query, number, grid.horizon());
      return Status::solved;
    }
    State& state = states_[number];
    if (state.closed) continue;
    state.closed = true;
    const float left = query.lengths[state.cell];
    if (static_cast<double>(left) <= query.arrived || state.time >= grid.horizon()) {
      finish(query, number);
      return Status::solved;
    }
    if (left < least) {
      least = left;
      nearest = number;
    }
    if (++expansions_ % 64 == 0) {
      if (const auto told = stop.status()) {
        finish(query, nearest);
        return *told;
      }
    }
    if (expansions_ > query.max_expansions) {
      finish(query, nearest);
      return Status::node_limit;
    }
    expand(grid, query, number);
    const State& expanded = states_[number];
    if (expanded.end == SpaceTimeGrid::forever && std::isfinite(left))
      push(query, number, grid.horizon() + expanded.turn_cost, Next::stay_to_horizon);
  }
  return Status::no_path;
}

void SafeIntervalSearch::begin(const SpaceTimeGrid& grid, const Query& query) {
  first_.resize(grid.size());
  search_.resize(grid.size());
  if (++number_ == 0) {
    std::fill(search_.begin(), search_.end(), 0);
    number_ = 1;
  }
  states_.clear();
  open_.clear();
  path_.clear();
  expansions_ = 0;
  arrival_ = cost_ = infinity;
  ahead_ = unit_vector(query.heading.value_or(0));
  State start;
  start.position = query.from;
  start.until = query.stay_until;
  start.closed = true;
  states_.push_back(start);
  for (const Cell cell : query.entries) connect(grid, query, 0, {cell, grid.position(cell)}, false);
}

void SafeIntervalSearch::expand(const SpaceTimeGrid& grid, const Query& query,
                                std::uint32_t number) {
  const Cell cell = states_[number].cell;
  const std::uint32_t parent = states_[number].parent;
  const int column = grid.column_of(cell);
  const int row = grid.row_of(cell);
  for (const GridStep& step : grid_steps()) {
    if (!grid.holds(column + step.column, row + step.row)) continue;
    const Cell next = grid.at(column + step.column, row + step.row);
    if (grid.stands(next) || !std::isfinite(query.lengths[next])) continue;
    const Place place{next, grid.position(column + step.column, row + step.row)};
    if (!is_useless(grid, number, next, false)) connect(grid, query, number, place, false);
    if (!is_useless(grid, parent, next, true)) connect(grid, query, parent, place, true);
  }
}

// Whether connect() to a cell with a single interval would change nothing, without a square root.
bool SafeIntervalSearch::is_useless(const SpaceTimeGrid& grid, std::uint32_t from_number, Cell to,
                                    bool is_shortcut) const {
  if (search_[to] != number_ || first_[to] == none || !grid.is_always_free(to)) return false;
  const State& state = states_[first_[to]];
  if (is_shortcut && state.parent == from_number) return true;
  const State& from = states_[from_number];
  return from.parent != none && from.time + from.turn_cost >= state.time + state.turn_cost;
}

// A cell is entered half a step before the arrival at its centre.
void SafeIntervalSearch::connect(const SpaceTimeGrid& grid, const Query& query,
                                 std::uint32_t from_number, const Place& to, bool is_shortcut) {
  const State from = states_[from_number];
  const Vec2 move = to.position - from.position;
  const double duration = norm(move) / query.speed;
  const double extent = std::max(std::abs(move.x), std::abs(move.y));
  const double half = extent > 0 ? 0.5 * duration * std::min(1.0, grid.cell() / extent) : 0;
  const double turn_cost = from.parent == none ? cost_of_turn(query, move) : from.turn_cost;
  const double earliest = from.time + turn_delay(query, from, move) + duration;
  for (int slot = grid.slot_at(earliest - half);;) {
    const SpaceTimeGrid::Interval safe = grid.safe_interval(to.cell, slot);
    if (safe.begin == SpaceTimeGrid::forever) return;
    const double first =
        safe.begin > slot ? std::max(earliest, safe.begin * grid.slot() + half) : earliest;
    if (first - duration > from.until + time_rounding) return;
    const std::uint32_t state = state_of(to, grid, safe.end);
    if (is_shortcut)
      note_shortcut(query, from_number, state, {first, turn_cost, duration});
    else
      relax(grid, query, from_number, state, {first, turn_cost, duration});
    if (safe.end == SpaceTimeGrid::forever) return;
    slot = safe.end;
  }
}

void SafeIntervalSearch::note_shortcut(const Query& query, std::uint32_t from, std::uint32_t to,
                                       const Move& move) {
  State& state = states_[to];
  const double cost = move.arrival + move.turn_cost;
  const double useful = std::min(state.time + state.turn_cost, state.shortcut_time);
  if (state.parent == from || move.arrival >= state.until || cost >= useful - time_rounding) return;
  state.shortcut = from;
  state.shortcut_time = cost;
  push(query, to, cost, Next::test_shortcut);
}

void SafeIntervalSearch::test_shortcut(const SpaceTimeGrid& grid, const Query& query,
                                       std::uint32_t number) {
  State& state = states_[number];
  if (state.shortcut == none) return;
  const State& from = states_[state.shortcut];
  const Vec2 move = state.position - from.position;
  const double turn_cost = from.parent == none ? cost_of_turn(query, move) : from.turn_cost;
  const std::uint32_t parent = std::exchange(state.shortcut, none);
  const double first = std::exchange(state.shortcut_time, infinity) - turn_cost;
  relax(grid, query, parent, number, {first, turn_cost, norm(move) / query.speed});
}

// Improves the arrival in a safe interval of a cell, if the way there permits. An expanded state
// is expanded again, since straight moves do not arrive in the order of expansion.
void SafeIntervalSearch::relax(const SpaceTimeGrid& grid, const Query& query,
                               std::uint32_t from_number, std::uint32_t to, const Move& move) {
  State& state = states_[to];
  const State& from = states_[from_number];
  const double useful = state.time + state.turn_cost - move.turn_cost - time_rounding;
  const double latest = std::min(from.until + time_rounding,
                                 std::min(state.until, useful) - time_rounding - move.duration);
  if (move.arrival - move.duration > latest) return;
  const double depart = grid.departure({from.position, state.position}, query.speed,
                                       move.arrival - move.duration, latest);
  if (depart > latest || depart == infinity) return;
  state.time = depart + move.duration;
  state.turn_cost = move.turn_cost;
  state.parent = from_number;
  state.closed = false;
  push(query, to, state.time + state.turn_cost, Next::expand);
}

void SafeIntervalSearch::push(const Query& query, std::uint32_t number, double cost, Next next) {
  const double left = static_cast<double>(query.lengths[states_[number].cell]) / query.speed;
  open_.push_back({cost + left, number, next});
  std::push_heap(open_.begin(), open_.end());
}

std::uint32_t SafeIntervalSearch::state_of(const Place& place, const SpaceTimeGrid& grid, int end) {
  const Cell cell = place.cell;
  if (search_[cell] != number_) {
    search_[cell] = number_;
    first_[cell] = none;
  }
  for (std::uint32_t i = first_[cell]; i != none; i = states_[i].next)
    if (states_[i].end == end) return i;
  State state;
  state.position = place.position;
  state.time = infinity;
  state.until = end == SpaceTimeGrid::forever ? infinity : end * grid.slot();
  state.cell = cell;
  state.next = first_[cell];
  state.end = end;
  first_[cell] = static_cast<std::uint32_t>(states_.size());
  states_.push_back(state);
  return first_[cell];
}

// Takes the path to a state, where the swarm waits until a time.
void SafeIntervalSearch::finish(const Query& query, std::uint32_t last, double until) {
  const State& end = states_[last];
  if (last != 0) {
    arrival_ =
        std::max(end.time, until) + static_cast<double>(query.lengths[end.cell]) / query.speed;
    cost_ = arrival_ + end.turn_cost;
  }
  for (std::uint32_t i = last; i != none; i = states_[i].parent)
    path_.push_back({states_[i].position, states_[i].time});
  std::reverse(path_.begin(), path_.end());
  if (until > end.time) path_.push_back({end.position, until});
}

}  // namespace microswarm::planning
