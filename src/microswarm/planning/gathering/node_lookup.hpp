// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/point_grid.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Lookup of the nearest of a fixed set of nodes, fast enough for a thousand robots per step. It is
/// a raster whose cells list the few candidate nodes. A node not visible from a cell (from its
/// centre and corners, as far as these are free) is listed only if no node is visible, so no robot
/// is sent through a wall. Queries do not allocate and are thread-safe.
class NodeLookup {
 public:
  NodeLookup() = default;
  /// `grid` holds the nodes, at least one. If `stop` ends it, cells that are left have the first
  /// node alone.
  NodeLookup(const Map& map, const PointGrid& grid, const Stop& stop = {});

  /// Nearest node visible from the cell of `p`, the lowest among equals. Points outside the bounds
  /// use the nearest cell. `nodes` must be those of the constructor.
  std::uint32_t nearest(Vec2 p, std::span<const Vec2> nodes) const {
    const std::span<const std::uint32_t> some = listed(column_of(p.x), row_of(p.y));
    std::uint32_t best = some[0];
    double least = squared_norm(nodes[best] - p);
    for (const std::uint32_t node : some.subspan(1)) {
      const double squared = squared_norm(nodes[node] - p);
      if (squared < least) {
        least = squared;
        best = node;
      }
    }
    return best;
  }
  /// Nearest node visible from `p` itself, exact; nothing if none is visible within about six times
  /// the usual distance between nodes. Slower: for one robot per step, not for all.
  std::optional<std::uint32_t> nearest_visible(const Map& map, Vec2 p,
                                               std::span<const Vec2> nodes) const;

 private:
  int column_of(double x) const { return clamped((x - origin_.x) * per_cell_.x, columns_); }
  int row_of(double y) const { return clamped((y - origin_.y) * per_cell_.y, rows_); }
  static int clamped(double i, int count) {
    return static_cast<int>(i > 0 ? (i < count - 1 ? i : count - 1) : 0);
  }
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::span<const std::uint32_t> listed(int column, int row) const {
    const std::size_t i = cell(column, row);
    return {listed_.data() + first_[i], listed_.data() + first_[i + 1]};
  }

  Vec2 origin_;
  Vec2 per_cell_{1, 1};
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;   ///< one per cell, and the end
  std::vector<std::uint32_t> listed_;  ///< candidate nodes of each cell, ascending
};

}  // namespace microswarm
