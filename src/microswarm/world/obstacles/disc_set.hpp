// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/uniform_grid.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Solid discs in flat arrays with exact queries; many discs use a bucket grid. Discs may overlap.
class DiscSet {
 public:
  /// Takes the discs among `bodies` and reuses the memory.
  void assign(std::span<const Body> bodies);

  std::size_t size() const { return discs_.size(); }
  bool empty() const { return discs_.empty(); }
  Disc disc(std::size_t i) const { return discs_[i]; }
  /// Index of disc i among the bodies.
  std::uint32_t enclosing_pose(std::size_t i) const { return bodies_[i]; }

  /// Distance [µm] to the nearest disc, 0 in one, at most `limit`.
  double clearance(Vec2 p, double limit) const;
  double clearance(Segment s, double limit) const;
  /// Whether every disc is at least r away and, for r = 0, not touched.
  bool is_free(Vec2 p, double r) const;
  bool is_free(Segment s, double r) const;
  /// Disc with the nearest rim within `limit`, depth inside counting as negative; size() if none.
  std::size_t nearest(Vec2 p, double limit) const;
  /// Calls visit(i) once for each disc that may meet the box, ascending within a bucket.
  template <class Visit>
  void for_each_in(const Box& box, Visit&& visit) const;

 private:
  using Run = UniformGrid::Run;
  bool bucketed() const { return !first_.empty(); }
  void fill_buckets();
  std::span<const std::uint32_t> discs_in(int row, Run columns) const {
    const std::uint32_t* first = first_.data() + grid_.number(0, row);
    return {ids_.data() + first[columns.first], ids_.data() + first[columns.last + 1]};
  }
  template <class Visit>
  bool all_near(const Box& box, Visit&& is_clear) const;
  template <class Visit>
  bool all_near(Segment s, double r, Visit&& is_clear) const;

  std::vector<Disc> discs_;
  std::vector<std::uint32_t> bodies_;
  UniformGrid grid_;
  std::vector<std::uint32_t> first_;  ///< start of each cell in ids_; one entry more than cells
  std::vector<std::uint32_t> ids_;
};

template <class Visit>
void DiscSet::for_each_in(const Box& box, Visit&& visit) const {
  if (!bucketed()) {
    for (std::size_t i = 0; i < size(); ++i) visit(i);
    return;
  }
  if (!box.overlaps(grid_.box())) return;
  const Run columns = grid_.column_range(box);
  const Run rows = grid_.row_range(box);
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      for (const std::uint32_t id : discs_in(row, {column, column})) {
        const Disc& d = discs_[id];
        const bool first_seen =
            column == std::max(columns.first, grid_.find_column(d.centre.x - d.radius)) &&
            row == std::max(rows.first, grid_.find_row(d.centre.y - d.radius));
        if (first_seen) visit(std::size_t{id});
      }
    }
  }
}

}  // namespace microswarm
