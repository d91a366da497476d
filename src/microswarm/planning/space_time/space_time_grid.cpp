// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/space_time_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::planning {
namespace {

/// Deviation from a cell's centre that does not count [cells].
constexpr double grid_rounding = 1e-6;

// std::floor and std::ceil are calls where the processor is not known to have an instruction.
int floor_to_int(double x) {
  const int i = static_cast<int>(x);
  return i - static_cast<int>(x < i);
}

int ceil_to_int(double x) {
  const int i = static_cast<int>(x);
  return i + static_cast<int>(x > i);
}

int cells_along(double length, double cell) {
  return std::max(1, static_cast<int>(std::floor(length / cell + grid_rounding)) + 1);
}

/// Indices from `low` to `high` among 0 to `count` - 1.
SpaceTimeGrid::Interval indices_between(double low, double high, int count) {
  return {ceil_to_int(std::clamp(low, 0.0, static_cast<double>(count))),
          floor_to_int(std::clamp(high, -1.0, static_cast<double>(count - 1)))};
}

}  // namespace

SpaceTimeGrid::SpaceTimeGrid(const Box& bounds, double cell, double slot, int slots)
    : cell_(cell),
      slot_(slot),
      slots_a_second_((1 - 1e-9) / slot),
      columns_(cells_along(bounds.width(), cell)),
      rows_(cells_along(bounds.height(), cell)),
      slots_(slots) {
  low_ = bounds.lo +
         0.5 * Vec2{bounds.width() - (columns_ - 1) * cell, bounds.height() - (rows_ - 1) * cell};
  standing_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  occupied_.resize(static_cast<std::size_t>((slots + 63) / 64) * size());
  if (slots > 64) return;
  body_rows_.resize(static_cast<std::size_t>(rows_));
  body_ends_.resize(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_ + 1));
}

int SpaceTimeGrid::slot_at(double t) const {
  return static_cast<int>(std::min(t / slot_ + grid_rounding, static_cast<double>(forever)));
}

SpaceTimeGrid::Cell SpaceTimeGrid::nearest(Vec2 p) const {
  const Vec2 offset = (p - low_) / cell_;
  const auto index = [](double at, int count) {
    return static_cast<int>(std::lround(std::clamp(at, 0.0, static_cast<double>(count - 1))));
  };
  return at(index(offset.x, columns_), index(offset.y, rows_));
}

void SpaceTimeGrid::clear_standing() { std::fill(standing_.begin(), standing_.end(), 0); }

void SpaceTimeGrid::clear() {
  for (auto at = occupied_.begin(); at != occupied_.end();)
    at = std::copy(standing_.begin(), standing_.end(), at);
}

SpaceTimeGrid::Interval SpaceTimeGrid::rows_between(double low, double high) const {
  return indices_between((low - low_.y) / cell_, (high - low_.y) / cell_, rows_);
}

SpaceTimeGrid::Interval SpaceTimeGrid::columns_between(double left, double right) const {
  return indices_between((left - low_.x) / cell_, (right - low_.x) / cell_, columns_);
}

void SpaceTimeGrid::occupy_row(int row, double left, double right, int slot) {
  const Interval columns = columns_between(left, right);
  std::uint64_t* const words = &word(at(0, row), slot);
  const std::uint64_t one = bit(slot);
  for (int i = columns.begin; i <= columns.end; ++i) words[i] |= one;
}

// Where the newest cells of the slot overlap or adjoin, they become one run.
void SpaceTimeGrid::occupy_row_of_body(int row, double left, double right, int slot) {
  if (slots_ > 64) return occupy_row(row, left, right, slot);
  const Interval cells = columns_between(left, right);
  if (cells.begin > cells.end) return;
  RowOfBody& body = body_rows_[static_cast<std::size_t>(row)];
  std::uint64_t* const ends =
      &body_ends_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_ + 1)];
  Interval run = cells;
  if (body.slot == slot) {
    if (cells.begin > body.newest.end + 1 || body.newest.begin > cells.end + 1)
      return occupy_row(row, left, right, slot);
    run = {std::min(cells.begin, body.newest.begin), std::max(cells.end, body.newest.end)};
    ends[body.newest.begin] ^= bit(slot);
    ends[body.newest.end + 1] ^= bit(slot);
  }
  ends[run.begin] ^= bit(slot);
  ends[run.end + 1] ^= bit(slot);
  body.slot = slot;
  body.newest = run;
  body.reached = {std::min(body.reached.begin, run.begin), std::max(body.reached.end, run.end)};
  used_rows_ = {std::min(used_rows_.begin, row), std::max(used_rows_.end, row)};
}

void SpaceTimeGrid::finish_body() {
  for (int row = used_rows_.begin; row <= used_rows_.end; ++row) {
    RowOfBody& body = body_rows_[static_cast<std::size_t>(row)];
    std::uint64_t* const ends =
        &body_ends_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_ + 1)];
    std::uint64_t inside = 0;
    for (int i = body.reached.begin; i <= body.reached.end; ++i) {
      inside ^= std::exchange(ends[i], 0);
      occupied_[at(i, row)] |= inside;
    }
    if (body.reached.end >= 0) ends[body.reached.end + 1] = 0;
    body = {};
  }
  used_rows_ = {forever, -1};
}

void SpaceTimeGrid::let_row_stand(int row, double left, double right) {
  const Interval columns = columns_between(left, right);
  for (int i = columns.begin; i <= columns.end; ++i) let_stand(at(i, row));
}

void SpaceTimeGrid::occupy(Disc disc, int slot) {
  const double r = disc.radius;
  if (!(r >= 0)) return;
  const Interval rows = rows_between(disc.centre.y - r, disc.centre.y + r);
  for (int row = rows.begin; row <= rows.end; ++row) {
    const double y = y_of(row) - disc.centre.y;
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    occupy_row(row, disc.centre.x - half, disc.centre.x + half, slot);
  }
}

// Calls use(share, cell, cell) for the two cells next to the move in each column that it crosses,
// or in each row if that is its longer extent, until one returns false. share() of the move runs
// from 0 to 1.
template <class Use>
bool SpaceTimeGrid::for_each_pair(Segment move, Use&& use) const {
  Vec2 a = (move.a - low_) / cell_;
  Vec2 b = (move.b - low_) / cell_;
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  if (steep) {
    std::swap(a.x, a.y);
    std::swap(b.x, b.y);
  }
  const double extent = b.x - a.x;
  if (std::abs(extent) < grid_rounding) return true;
  const int direction = extent > 0 ? 1 : -1;
  const int along = (steep ? rows_ : columns_) - 1;
  const int across = (steep ? columns_ : rows_) - 1;
  const double slope = (b.y - a.y) / extent;
  const auto first = extent > 0 ? std::ceil(a.x - grid_rounding) : std::floor(a.x + grid_rounding);
  const auto last = extent > 0 ? std::floor(b.x + grid_rounding) : std::ceil(b.x - grid_rounding);
  const int end = static_cast<int>(last);
  for (int i = static_cast<int>(first); direction * (end - i) >= 0; i += direction) {
    if (i < 0 || i > along) continue;
    const double beside = a.y + slope * (i - a.x);
    const int low = std::clamp(floor_to_int(beside + grid_rounding), 0, across);
    const int high = std::clamp(ceil_to_int(beside - grid_rounding), 0, across);
    if (!use([&] { return (i - a.x) / extent; }, steep ? at(low, i) : at(i, low),
             steep ? at(high, i) : at(i, high)))
      return false;
  }
  return true;
}

/// Last slot from `first` to `last` in which one of two cells is occupied, else one before `first`.
int SpaceTimeGrid::last_occupied(Cell a, Cell b, int first, int last) const {
  while (last >= first) {
    const std::uint64_t busy = (word(a, last) | word(b, last)) << (63 - last % 64);
    if (busy != 0) return last - std::countl_zero(busy);
    last -= last % 64 + 1;
  }
  return last;
}

bool SpaceTimeGrid::is_open(Segment move) const {
  return for_each_pair(move,
                       [&](auto&&, Cell low, Cell high) { return !stands(low) && !stands(high); });
}

// After a conflict in a slot the point must leave so late that it gets there after the slot.
double SpaceTimeGrid::departure(Segment move, double speed, double depart, double latest) const {
  const double duration = distance(move.a, move.b) / speed;
  const Vec2 extent = move.b - move.a;
  const double half = 0.5 * cell_ / std::max(std::abs(extent.x), std::abs(extent.y));
  while (depart <= latest && depart < infinity) {
    double later = depart;
    const bool free = for_each_pair(move, [&](auto&& share_of_pair, Cell low, Cell high) {
      if (is_always_free(low) && is_always_free(high)) return true;
      const double share = share_of_pair();
      const double since = std::max(0.0, share - half) * duration;
      const int first = slot_at(depart + since);
      if (first >= slots_) {
        if (stands(low) || stands(high)) later = infinity;
        return std::isfinite(later);
      }
      const double until = std::min(1.0, share + half) * duration;
      const int last = std::min(slots_ - 1, slot_at(depart + until - 4 * grid_rounding * slot_));
      const int slot = last_occupied(low, high, first, last);
      if (slot < first) return true;
      later = std::max((slot + 1) * slot_ - since, depart + slot_ * grid_rounding);
      return false;
    });
    if (free) return depart;
    depart = later;
  }
  return infinity;
}

}  // namespace microswarm::planning
