// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "microswarm/geometry/point_grid.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

/// Marks the absence of a tree node.
inline constexpr std::uint32_t no_node = ~0u;

/// Adds nodes to a tree until a node is visible from everywhere that can be reached from its root.
/// A randomly grown tree misses narrow branches of a wide map. Starting from the root, over grid
/// cells that see their neighbours' centres, each cell's centre must see a node within `radius`
/// [µm]; otherwise the centre of the preceding cell becomes a node. `nodes` are those of the tree,
/// the root first. `add(p, parent)` must add a node to the tree and to `nodes`. Cells are `cell` µm
/// wide, or wider on a map of more than four million cells.
void cover(const Map& map, const PointGrid& nodes, double cell, double radius,
           const std::function<void(Vec2 p, std::uint32_t parent)>& add);

}  // namespace microswarm::planning
