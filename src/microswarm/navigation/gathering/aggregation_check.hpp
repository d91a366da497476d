// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm::navigation {

/// Properties of a map and a goal that [gather] assumes.
struct MapAssumptions {
  double reached_share = 0;  ///< of the free area that is connected to the goal; should be 1
  int exits = 0;             ///< channels that leave the goal; 1 at a dead end
};

/// Examines a map with channels of about `width` [µm] on a grid of some million positions, and the
/// surroundings of the goal up to 1.25 widths.
MapAssumptions map_assumptions(const Map& map, Vec2 goal, double width);

/// Violated assumptions of [gather], one line each: the map is connected, and the goal is in a
/// region with a single exit. Aggregation still works without them, but less well: robots not
/// connected with the goal stay where they are, and from a goal that is no dead end robots are
/// pushed out again.
std::vector<std::string> unmet_assumptions(const Map& map, Vec2 goal, double width);

/// Reason why HRA may need fewer steps than DCA: the map has too few regions to divide. Empty if it
/// has enough.
std::string too_few_regions(std::size_t regions);

}  // namespace microswarm::navigation
