// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"
#include "microswarm/geometry/uniform_grid.hpp"

namespace microswarm {

/// Static bucket grid over the directed edges of closed rings (solid on the left), for exact
/// distance, containment and proximity queries, also outside its box. Flat arrays; queries do not
/// allocate and are thread-safe. Bodies may touch or overlap: the solid is their union, and every
/// edge still counts as an edge.
class EdgeGrid {
 public:
  EdgeGrid() = default;
  /// `enclosing_pose[i]` is the body that edge i belongs to. The cell size [µm] is derived from the
  /// edges if `cell` is 0.
  EdgeGrid(std::span<const Segment> edges, std::span<const std::uint32_t> enclosing_pose,
           double cell = 0) {
    assign(edges, enclosing_pose, cell);
  }
  /// Same as constructing, but reuses the memory.
  void assign(std::span<const Segment> edges, std::span<const std::uint32_t> enclosing_pose,
              double cell = 0);

  std::size_t size() const { return edges_.size(); }
  bool empty() const { return edges_.empty(); }
  const Segment& edge(std::size_t i) const { return edges_[i]; }
  std::span<const Segment> edges() const { return edges_; }
  std::uint32_t enclosing_pose(std::size_t i) const { return bodies_[i]; }
  const Box& box() const { return grid_.box(); }
  /// Side of a cell [µm].
  double cell() const { return grid_.cell().x; }

  /// Distance [µm] from `p` to the nearest edge, or `limit` if none is nearer.
  double distance(Vec2 p, double limit) const;
  /// Index of the nearest edge within `limit`, the lowest among equals; size() if there is none.
  std::size_t nearest(Vec2 p, double limit) const;
  /// Whether `p` is in the solid or on an edge. Exact.
  bool in_solid(Vec2 p) const;
  /// Winding number of the rings around p (moved by an infinitesimal, so that it is on no edge):
  /// the number of bodies that contain it.
  int winding(Vec2 p) const;
  /// Whether the capsule of radius r around s is clear of every edge (distance >= r; not touching
  /// if r = 0). Exact.
  bool capsule_free(Segment s, double r) const;
  /// Distance [µm] from the segment to the nearest edge, or `limit` if none is nearer.
  double distance(Segment s, double limit) const;
  /// Calls visit(edge index) once for every edge that may meet `box`.
  template <class Visit>
  void for_each_in(const Box& box, Visit&& visit) const;

 private:
  using Run = UniformGrid::Run;
  /// The edges of a cell are ids_[first .. first of the next cell).
  struct Cell {
    std::uint32_t first = 0;
    /// Winding number of the rings around the cell's centre.
    std::int32_t winding = 0;
  };
  class Seen;
  struct Found {
    double squared;
    std::size_t edge;
  };

  UniformGrid::Sweep sweep(Segment s, double reach) const { return {grid_, s, reach, slack_}; }
  double padded_reach(Segment s, double r) const;
  bool disc_free(Vec2 p, double r) const;
  double choose_cell(const Box& box, double cell);
  void fill_cells();
  void find_windings();
  Found search(Vec2 p, double squared_limit) const;
  void scan(Vec2 p, int row, Run columns, Found& best) const;
  std::span<const std::uint32_t> edges_in(int row, Run columns) const {
    const Cell* cells = cells_.data() + grid_.number(0, row);
    return {ids_.data() + cells[columns.first].first, ids_.data() + cells[columns.last + 1].first};
  }
  bool first_seen_in(std::uint32_t edge, int column, int row, Run wanted, int first_row) const;
  Run columns_of_edge(std::uint32_t edge, int row) const;

  UniformGrid grid_;
  /// Exceeds any rounding error of a cell border.
  double slack_ = 0;
  std::vector<Segment> edges_;
  std::vector<std::uint32_t> bodies_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> ids_;
};

/// Small set of edges, on the stack.
class EdgeGrid::Seen {
 public:
  static constexpr std::size_t most = 512;

  /// For at most `count` <= most edges.
  explicit Seen(std::size_t count) : mask_(std::bit_ceil(2 * count + 1) - 1) {
    std::fill_n(slots_.begin(), mask_ + 1, none);
  }
  /// Whether it is new.
  bool insert(std::uint32_t edge) {
    constexpr std::uint32_t mix = 0x9E3779B1;
    for (std::size_t slot = ((edge * mix) >> 16) & mask_;; slot = (slot + 1) & mask_) {
      if (slots_[slot] == edge) return false;
      if (slots_[slot] != none) continue;
      slots_[slot] = edge;
      return true;
    }
  }

 private:
  static constexpr std::uint32_t none = ~0u;
  std::size_t mask_;
  std::array<std::uint32_t, 4 * most> slots_;
};

template <class Visit>
void EdgeGrid::for_each_in(const Box& box, Visit&& visit) const {
  if (empty() || !box.overlaps(grid_.box())) return;
  const Run wanted = grid_.column_range(box);
  const auto [first_row, last_row] = grid_.row_range(box);
  std::size_t count = 0;
  for (int row = first_row; row <= last_row; ++row) count += edges_in(row, wanted).size();
  if (count <= Seen::most) {
    Seen seen(count);
    for (int row = first_row; row <= last_row; ++row)
      for (const std::uint32_t id : edges_in(row, wanted))
        if (seen.insert(id)) visit(std::size_t{id});
    return;
  }
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = wanted.first; column <= wanted.last; ++column) {
      for (const std::uint32_t id : edges_in(row, {column, column})) {
        if (first_seen_in(id, column, row, wanted, first_row)) visit(std::size_t{id});
      }
    }
  }
}

}  // namespace microswarm
