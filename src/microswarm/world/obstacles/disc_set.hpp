// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/distance.hpp"
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
  std::uint32_t body_of(std::size_t i) const { return bodies_[i]; }

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
  struct Run {
    int first;
    int last;
  };
  bool bucketed() const { return !first_.empty(); }
  int column_of(double x) const { return index(x - box_.lo.x, columns_); }
  int row_of(double y) const { return index(y - box_.lo.y, rows_); }
  int index(double offset, int count) const {
    const double last = count - 1;
    const double i = offset * per_cell_;
    return static_cast<int>(i > 0 ? (i < last ? i : last) : 0);
  }
  void fill_buckets();
  template <class Visit>
  bool all_near(const Box& box, Visit&& is_clear) const;
  template <class Visit>
  bool all_near(Segment s, double r, Visit&& is_clear) const;

  std::vector<Disc> discs_;
  std::vector<std::uint32_t> bodies_;
  Box box_;
  double cell_ = 1;
  double per_cell_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< start of each cell in ids_; one entry more than cells
  std::vector<std::uint32_t> ids_;
};

template <class Visit>
void DiscSet::for_each_in(const Box& box, Visit&& visit) const {
  if (!bucketed()) {
    for (std::size_t i = 0; i < size(); ++i) visit(i);
    return;
  }
  if (!box.overlaps(box_)) return;
  const Run columns{column_of(box.lo.x), column_of(box.hi.x)};
  const Run rows{row_of(box.lo.y), row_of(box.hi.y)};
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row) * columns_ + column;
      for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
        const Disc& d = discs_[ids_[k]];
        const bool first_seen =
            column == std::max(columns.first, column_of(d.centre.x - d.radius)) &&
            row == std::max(rows.first, row_of(d.centre.y - d.radius));
        if (first_seen) visit(std::size_t{ids_[k]});
      }
    }
  }
}

}  // namespace microswarm
