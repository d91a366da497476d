// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "microswarm/world/map/lattice.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::navigation {

/// Neighbouring cells of a CellGraph, and how far they are apart.
enum class CellSteps {
  hops,     ///< all of the eight that are free, past corners too; each is 1 step away
  lengths,  ///< those to which the way is free; a diagonal is 7/5 of a straight step
};

/// Free cells of a map as a graph, for distances between any two places. A cell is free if its
/// centre is.
class CellGraph {
 public:
  static constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t directions = 8;  ///< counter-clockwise from +x

  /// Cells `cell` µm wide, the first at the lower left corner of the bounds; wider ones where there
  /// would be more than 4 million. Throws InputError if no cell is free.
  CellGraph(const Map& map, double cell, CellSteps steps);

  /// Direction of an offset by its signs; 0 for none.
  static std::size_t nearest_direction(Vec2 offset);

  std::uint32_t size() const { return static_cast<std::uint32_t>(centres_.size()); }
  Vec2 operator[](std::uint32_t node) const { return centres_[node]; }
  /// Neighbour in a direction; the node itself if that one is no neighbour.
  std::uint32_t neighbour(std::uint32_t node, std::size_t direction) const {
    return neighbours_[node][direction];
  }
  /// The cell that holds `p`, a free one.
  std::uint32_t at(Vec2 p) const { return at_[lattice_.nearest(p)]; }
  /// Nearest free cell, of those around `p` one that sees it if there is one. `map` is the graph's.
  std::uint32_t nearest(const Map& map, Vec2 p) const;

  /// Shortest path lengths from a node, in units; where `until` is a node, of those that are not
  /// farther than it, and some more.
  std::vector<std::uint32_t> distances(std::uint32_t from, std::uint32_t until = unreached) const;
  /// Neighbour of `node` on a shortest path to where `distances` begin, the first in the order of
  /// directions; itself at their beginning or if it was not reached.
  std::uint32_t towards(const std::vector<std::uint32_t>& distances, std::uint32_t node) const;
  /// Length of a unit [µm].
  double unit() const { return cell_ / cost(0); }

 private:
  std::uint32_t cost(std::size_t direction) const {
    if (steps_ == CellSteps::hops) return 1;
    return direction % 2 == 0 ? 5 : 7;
  }

  CellSteps steps_;
  NodeLattice lattice_;
  double cell_;
  std::vector<Vec2> centres_;
  std::vector<std::uint32_t> at_;  ///< node at each lattice place; unreached where there is none
  std::vector<std::array<std::uint32_t, directions>> neighbours_;
};

}  // namespace microswarm::navigation
