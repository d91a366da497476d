// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/planning/gathering/map_segmentation.hpp"

namespace microswarm {

/// What of the ground [gather] assumes is so for a goal on a map.
struct MapAssumptions {
  double reached_share = 0;  ///< of the free area, from where the goal is reached; should be 1
  int exits = 0;             ///< channels that lead away from the goal; 1 at a dead end
};

/// Looks at a map with channels of about `width` [µm]: over a grid of some million places, and the
/// surroundings of the goal out to 1.25 widths.
MapAssumptions map_assumptions(const Map& map, Vec2 goal, double width);

/// The assumptions of [gather] that do not hold, one line each: the map is connected, and the goal
/// lies in a region that is closed but for one channel. Aggregation works without them, less well:
/// robots that are not connected with the goal stay where they are, and from a goal that is no dead
/// end robots are pushed out again.
std::vector<std::string> unmet_assumptions(const Map& map, Vec2 goal, double width);

/// Why HRA may need fewer steps than DCA: the map has too few regions to be divided. Empty where it
/// has enough.
std::string too_few_regions(const MapSegmentation& segmentation);

}  // namespace microswarm
