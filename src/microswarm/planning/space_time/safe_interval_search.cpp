// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/safe_interval_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
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
  reached_.resize(grid.size());
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
  reached_.resize(grid.size());
  if (++number_ == 0) {
    std::fill(reached_.begin(), reached_.end(), Reached{});
    number_ = 1;
  }
  const double cell_time = grid.cell() / query.speed;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const GridStep& step = grid_steps()[k];
    const int extent = std::max(std::abs(step.column), std::abs(step.row));
    const double duration = step.length * cell_time;
    steps_[k] = {step.column, step.row, duration, 0.5 * duration / extent};
  }
  states_.clear();
  open_.clear();
  path_.clear();
  expansions_ = 0;
  arrival_ = cost_ = infinity;
  ahead_ = unit_vector(query.heading.value_or(0));
  State start;
  start.position = query.from;
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
  for (const Step& step : steps_) {
    if (!grid.holds(column + step.column, row + step.row)) continue;
    const Cell next = grid.at(column + step.column, row + step.row);
    if (!std::isfinite(query.lengths[next]) || grid.stands(next)) continue;
    const Place place{next, grid.position(column + step.column, row + step.row)};
    const bool is_known = reached_[next].search == number_;
    if (!is_known || !is_useless(grid, number, next, step_bounds(grid, query, number, step), false))
      connect(grid, query, number, place, false);
    if (!is_known ||
        !is_useless(grid, parent, next, shortcut_bounds(grid, query, parent, place.position), true))
      connect(grid, query, parent, place, true);
  }
}

SafeIntervalSearch::Bounds SafeIntervalSearch::step_bounds(const SpaceTimeGrid& grid,
                                                           const Query& query, std::uint32_t from,
                                                           const Step& step) const {
  const State& state = states_[from];
  return {grid.slot_before(state.time), state.time + step.duration, step.half,
          until(grid, query, from) + step.duration};
}

SafeIntervalSearch::Bounds SafeIntervalSearch::shortcut_bounds(const SpaceTimeGrid& grid,
                                                               const Query& query,
                                                               std::uint32_t from, Vec2 to) const {
  const State& state = states_[from];
  const Vec2 move = to - state.position;
  const double pace = 2 * steps_[0].half / grid.cell();  // [s/µm]
  const double duration = norm(move) * pace;
  const bool is_long = std::max(std::abs(move.x), std::abs(move.y)) > 0.5 * grid.cell();
  const double entered = std::max(0.0, duration - std::numbers::sqrt2 * steps_[0].half);
  return {grid.slot_before(state.time + entered), state.time + duration,
          is_long ? steps_[0].half : 0, until(grid, query, from) + duration};
}

// Whether connect() would change nothing, by bounds without divisions: every safe interval that
// it can reach has a state that is reached as early.
bool SafeIntervalSearch::is_useless(const SpaceTimeGrid& grid, std::uint32_t from_number, Cell to,
                                    const Bounds& bounds, bool is_shortcut) const {
  if (reached_[to].first == none) return false;
  const State& from = states_[from_number];
  for (int slot = bounds.slot;;) {
    const SpaceTimeGrid::Interval safe = grid.safe_interval(to, slot);
    const double begin = safe.begin * grid.slot();
    if (begin > bounds.latest + 2 * time_rounding) return true;
    std::uint32_t i = reached_[to].first;
    while (i != none && states_[i].end != safe.end) i = states_[i].next;
    if (i == none) return false;
    const State& state = states_[i];
    if (!is_shortcut || state.parent != from_number) {
      double useful = state.time + state.turn_cost;
      if (is_shortcut) useful = std::min(useful, state.shortcut_time);
      const double arrival = std::max(bounds.arrival, begin + bounds.half - 2e-6 * grid.slot());
      if (arrival + from.turn_cost < useful - 0.5 * time_rounding) return false;
    }
    if (safe.end == SpaceTimeGrid::forever) return true;
    slot = safe.end;
  }
}

// A cell is entered half a step before the arrival at its centre.
void SafeIntervalSearch::connect(const SpaceTimeGrid& grid, const Query& query,
                                 std::uint32_t from_number, const Place& to, bool is_shortcut) {
  const State& from = states_[from_number];
  const Vec2 move = to.position - from.position;
  const double duration = norm(move) / query.speed;
  const double extent = std::max(std::abs(move.x), std::abs(move.y));
  const double half = extent > 0 ? 0.5 * duration * std::min(1.0, grid.cell() / extent) : 0;
  const double turn_cost = from.parent == none ? cost_of_turn(query, move) : from.turn_cost;
  const double earliest = from.time + turn_delay(query, from, move) + duration;
  const double stays_until = until(grid, query, from_number);
  for (int slot = grid.slot_at(earliest - half);;) {
    const SpaceTimeGrid::Interval safe = grid.safe_interval(to.cell, slot);
    if (safe.begin == SpaceTimeGrid::forever) return;
    const double first =
        safe.begin > slot ? std::max(earliest, safe.begin * grid.slot() + half) : earliest;
    if (first - duration > stays_until + time_rounding) return;
    const std::uint32_t state = state_of(to, safe.end);
    if (is_shortcut)
      note_shortcut(grid, query, from_number, state, {first, turn_cost, duration});
    else
      relax(grid, query, from_number, state, {first, turn_cost, duration});
    if (safe.end == SpaceTimeGrid::forever) return;
    slot = safe.end;
  }
}

void SafeIntervalSearch::note_shortcut(const SpaceTimeGrid& grid, const Query& query,
                                       std::uint32_t from, std::uint32_t to, const Move& move) {
  State& state = states_[to];
  const double cost = move.arrival + move.turn_cost;
  const double useful = std::min(state.time + state.turn_cost, state.shortcut_time);
  if (state.parent == from || move.arrival >= until(grid, query, to) ||
      cost >= useful - time_rounding)
    return;
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
  const double latest =
      std::min(until(grid, query, from_number) + time_rounding,
               std::min(until(grid, query, to), useful) - time_rounding - move.duration);
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

/// End of the safe interval of a state [s].
double SafeIntervalSearch::until(const SpaceTimeGrid& grid, const Query& query,
                                 std::uint32_t number) const {
  if (number == 0) return query.stay_until;
  const int end = states_[number].end;
  return end == SpaceTimeGrid::forever ? infinity : end * grid.slot();
}

std::uint32_t SafeIntervalSearch::state_of(const Place& place, int end) {
  const Cell cell = place.cell;
  if (reached_[cell].search != number_) reached_[cell] = {number_, none};
  for (std::uint32_t i = reached_[cell].first; i != none; i = states_[i].next)
    if (states_[i].end == end) return i;
  State state;
  state.position = place.position;
  state.time = infinity;
  state.cell = cell;
  state.next = reached_[cell].first;
  state.end = end;
  reached_[cell].first = static_cast<std::uint32_t>(states_.size());
  states_.push_back(state);
  return reached_[cell].first;
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
