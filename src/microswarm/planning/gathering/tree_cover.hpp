// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "microswarm/geometry/point_grid.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Instead of a node of a tree: none.
inline constexpr std::uint32_t no_node = ~0u;

/// Adds nodes to a tree until all that can be reached from its root sees it: a tree grown at random
/// misses narrow branches of a wide map. From the root on, over the cells of a grid that see their
/// neighbours' centres, each cell's centre must see a node within `radius` [µm]; where it does not,
/// the centre of the cell before it becomes one. `nodes` are those of the tree, the root first;
/// `add(p, parent)` adds one to the tree and to them. The cells are `cell` µm wide, or wider on a
/// map of more than four million.
void cover(const Map& map, const PointGrid& nodes, double cell, double radius,
           const std::function<void(Vec2 p, std::uint32_t parent)>& add);

}  // namespace microswarm
