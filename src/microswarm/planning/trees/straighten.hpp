// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/planning/trees/search_tree.hpp"

namespace microswarm::planning {

/// Number of rounds used by D-RRT*.
inline constexpr int straighten_rounds = 2;

/// Straightens a collision-free path, beyond [drrt]. Takes the cheapest chain of free edges through
/// points of the path: first through its vertices, then `rounds` times through its vertices and
/// points between them. Start and end stay, the cost never grows, and every edge of the result is
/// checked with the clearance. Adds its edge checks to `checks`.
void straighten(const Snapshot& world, double clearance, double start_heading, PathCost cost,
                int rounds, std::vector<Vec2>& path, std::uint64_t& checks);

}  // namespace microswarm::planning
