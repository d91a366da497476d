// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm::planning {

/// Grid of square cells over the bounds of a map and of time slots over a horizon: which cells are
/// occupied when. A cell that stands is occupied at all times, also after the horizon; all others
/// are free after it. A safe interval of a cell is a maximal run of slots in which it is free
/// (Phillips and Likhachev 2011). Time 0 is the start of the first slot. Allocates in the
/// constructor only.
class SpaceTimeGrid {
 public:
  using Cell = std::uint32_t;

  /// Slots from `begin` on, before `end`.
  struct Interval {
    int begin = 0;
    int end = 0;
  };
  /// Number that `Interval::end` has if the cell stays free.
  static constexpr int forever = 1 << 30;

  SpaceTimeGrid() = default;
  /// Cells of side `cell` [µm]; `slots` slots of `slot` seconds. All cells are free.
  SpaceTimeGrid(const Box& bounds, double cell, double slot, int slots);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t size() const { return standing_.size(); }
  /// Side of a cell [µm].
  double cell() const { return cell_; }
  /// Duration of a slot [s].
  double slot() const { return slot_; }
  int slots() const { return slots_; }
  /// End of the last slot [s].
  double horizon() const { return slot_ * slots_; }
  /// Number of the slot at time `t` >= 0 [s]; at least slots() after the horizon.
  int slot_at(double t) const;
  /// That slot or, by rounding, the one before, without a division.
  int slot_before(double t) const {
    return t < horizon() ? static_cast<int>(t * slots_a_second_) : slots_;
  }

  Cell at(int column, int row) const {
    return static_cast<Cell>(row) * static_cast<Cell>(columns_) + static_cast<Cell>(column);
  }
  int column_of(Cell c) const { return static_cast<int>(c % static_cast<Cell>(columns_)); }
  int row_of(Cell c) const { return static_cast<int>(c / static_cast<Cell>(columns_)); }
  bool holds(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  /// Centre of a cell [µm].
  Vec2 position(Cell c) const { return position(column_of(c), row_of(c)); }
  Vec2 position(int column, int row) const {
    return low_ + cell_ * Vec2{static_cast<double>(column), static_cast<double>(row)};
  }
  /// Cell whose centre is nearest to `p`.
  Cell nearest(Vec2 p) const;

  /// Lets no cell stand.
  void clear_standing();
  void let_stand(Cell c) { standing_[c] = ~std::uint64_t{0}; }
  /// The cells of a row with centres from x = `left` to `right` [µm].
  void let_row_stand(int row, double left, double right);
  bool stands(Cell c) const { return standing_[c] != 0; }
  /// Frees all cells that do not stand.
  void clear();
  /// Occupies, in one slot, the cells whose centres are at most `radius` from `centre` [µm].
  void occupy(Disc disc, int slot);
  /// Occupies, in one slot, the cells of a row with centres from x = `left` to `right` [µm].
  void occupy_row(int row, double left, double right, int slot);
  void occupy(Cell c, int slot) { word(c, slot) |= bit(slot); }
  /// The same as occupy_row() for the many rows and slots of one moving body, once finish_body() is
  /// called: only the ends of each row are written at first.
  void occupy_row_of_body(int row, double left, double right, int slot);
  void finish_body();
  /// Rows with centres from y = `low` to `high` [µm]: first and last, which is less if there is
  /// none.
  Interval rows_between(double low, double high) const;
  /// y [µm] of the centres of a row.
  double y_of(int row) const { return low_.y + cell_ * row; }

  bool is_free(Cell c, int slot) const {
    return slot >= slots_ ? !stands(c) : (word(c, slot) & bit(slot)) == 0;
  }
  /// Whether the cell is occupied in no slot and does not stand.
  bool is_always_free(Cell c) const {
    for (std::size_t i = c; i < occupied_.size(); i += size())
      if (occupied_[i] != 0) return false;
    return true;
  }
  /// The first safe interval of `c` that ends after `slot`; `begin` is at least `slot`. Empty
  /// (begin = end = forever) if there is none.
  Interval safe_interval(Cell c, int slot) const {
    if (stands(c)) return {forever, forever};
    const int begin = next_free(c, slot);
    return {begin, next_occupied(c, begin)};
  }
  /// Earliest time from `depart` to `latest` [s] at which a point can leave `a` that moves straight
  /// to `b` at `speed` [µm/s] and must be in free cells all the time; infinity if there is none. Of
  /// each column (or row, if it moves along the rows) it needs both cells next to it, while it is
  /// the nearest column.
  double departure(Segment move, double speed, double depart, double latest) const;
  /// Whether it can leave at `depart`.
  bool is_free(Segment move, double speed, double depart) const {
    return departure(move, speed, depart, depart) <= depart;
  }
  /// The same for cells that stand.
  bool is_open(Segment move) const;

 private:
  struct Line;

  static std::uint64_t bit(int slot) { return std::uint64_t{1} << (slot % 64); }
  std::uint64_t& word(Cell c, int slot) {
    return occupied_[static_cast<std::size_t>(slot / 64) * size() + c];
  }
  const std::uint64_t& word(Cell c, int slot) const {
    return occupied_[static_cast<std::size_t>(slot / 64) * size() + c];
  }
  Interval columns_between(double left, double right) const;
  int next_free(Cell c, int slot) const {
    while (slot < slots_) {
      const std::uint64_t free = ~word(c, slot) >> (slot % 64);
      if (free != 0) return std::min(slots_, slot + std::countr_zero(free));
      slot += 64 - slot % 64;
    }
    return slot;
  }
  int next_occupied(Cell c, int slot) const {
    while (slot < slots_) {
      const std::uint64_t busy = word(c, slot) >> (slot % 64);
      if (busy != 0) return std::min(forever, slot + std::countr_zero(busy));
      slot += 64 - slot % 64;
    }
    return forever;
  }
  int last_occupied(Cell a, Cell b, int first, int last) const;
  template <class Use>
  bool for_each_pair(Segment move, Use&& use) const;

  Vec2 low_;
  double cell_ = 1;
  double slot_ = 1;
  double slots_a_second_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  int slots_ = 0;
  std::vector<std::uint64_t> standing_;  ///< all bits set for a cell that stands
  std::vector<std::uint64_t> occupied_;  ///< a bit for each slot, 64 slots of all cells together
  /// Of a body in a row: the cells that it reaches so far, and those in its newest slot.
  struct RowOfBody {
    Interval reached{forever, -1};
    Interval newest{};
    int slot = -1;
  };
  std::vector<RowOfBody> body_rows_;
  std::vector<std::uint64_t>
      body_ends_;  ///< by cell, and one more a row: where a slot begins or ends
  Interval used_rows_{forever, -1};
};

}  // namespace microswarm::planning
