// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Square lattice of nodes over a box, at most half a spacing from its border. Each node is joined
/// to its eight neighbours.
class NodeLattice {
 public:
  /// `spacing` [µm]; 0 chooses it for about `nodes` nodes. The lattice never has more than 40 times
  /// as many.
  NodeLattice(const Box& box, double spacing, double nodes) {
    const double longest = std::max(box.width(), box.height());
    const double area = box.width() * box.height();
    const double wanted = std::max(std::sqrt(area / nodes), longest / nodes);
    spacing_ = spacing > 0 ? std::max(spacing, wanted / std::sqrt(40.0)) : wanted;
    columns_ = std::max(1, static_cast<int>(std::ceil(box.width() / spacing_)));
    rows_ = std::max(1, static_cast<int>(std::ceil(box.height() / spacing_)));
    first_ = box.centre() - 0.5 * spacing_ * Vec2{columns_ - 1.0, rows_ - 1.0};
  }

  /// Distance between neighbouring nodes [µm].
  double spacing() const { return spacing_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(columns_ * rows_); }
  Vec2 operator[](std::uint32_t node) const {
    const int n = static_cast<int>(node);
    const int row = n / columns_;
    return first_ + spacing_ * Vec2{static_cast<double>(n % columns_), static_cast<double>(row)};
  }

  /// The node nearest to a point; at the border for points outside.
  std::uint32_t nearest(Vec2 p) const {
    const Vec2 offset = (p - first_) / spacing_ + Vec2{0.5, 0.5};
    const int column = std::clamp(static_cast<int>(offset.x), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(offset.y), 0, rows_ - 1);
    return static_cast<std::uint32_t>(row * columns_ + column);
  }

  /// Visits the neighbours to the right and above, so that each pair is visited once.
  template <class Visit>
  void for_each_later_neighbour(std::uint32_t node, Visit&& visit) const {
    for (const auto& [i, j] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}})
      visit_at(node, i, j, visit);
  }
  template <class Visit>
  void for_each_neighbour(std::uint32_t node, Visit&& visit) const {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        if (i != 0 || j != 0) visit_at(node, i, j, visit);
      }
    }
  }
  /// Visits the up to 16 nodes around a point, two on each side per axis.
  template <class Visit>
  void for_each_around(Vec2 p, Visit&& visit) const {
    const int left = static_cast<int>(std::floor((p.x - first_.x) / spacing_));
    const int bottom = static_cast<int>(std::floor((p.y - first_.y) / spacing_));
    for (int row = bottom - 1; row <= bottom + 2; ++row) {
      for (int column = left - 1; column <= left + 2; ++column) {
        if (row < 0 || column < 0 || row >= rows_ || column >= columns_) continue;
        visit(static_cast<std::uint32_t>(row * columns_ + column));
      }
    }
  }

 private:
  template <class Visit>
  void visit_at(std::uint32_t node, int i, int j, Visit& visit) const {
    const int column = static_cast<int>(node) % columns_ + i;
    const int row = static_cast<int>(node) / columns_ + j;
    if (row < 0 || column < 0 || row >= rows_ || column >= columns_) return;
    visit(static_cast<std::uint32_t>(row * columns_ + column));
  }

  double spacing_;
  int columns_;
  int rows_;
  Vec2 first_;
};

}  // namespace microswarm
