// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/point_grid.hpp"
#include "microswarm/geometry/uniform_grid.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

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
    const std::span<const std::uint32_t> some = listed(grid_.number_at(p));
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
  std::span<const std::uint32_t> listed(std::size_t cell) const {
    return {listed_.data() + first_[cell], listed_.data() + first_[cell + 1]};
  }

  UniformGrid grid_;
  std::vector<std::uint32_t> first_;   ///< one per cell, and the end
  std::vector<std::uint32_t> listed_;  ///< candidate nodes of each cell, ascending
};

}  // namespace microswarm::planning
