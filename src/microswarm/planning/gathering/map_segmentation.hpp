// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/planning/gathering/map_segmentation_params.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"

namespace microswarm::planning {

/// Partition of the nodes: every node belongs to one region and one branch of it. Regions are
/// numbered by the cost of their gates, so `next` descends to the goal's region 0, which is its own
/// next. The farthest region that contains a robot is the one with the highest number.
struct MapSegmentation {
  std::vector<Region> regions{};
  std::vector<std::uint32_t> region{};          ///< ψ, one per node
  std::vector<std::uint32_t> branch{};          ///< φ, one per node, from 0 in each region
  std::vector<std::uint32_t> junction_nodes{};  ///< V_J, ascending
};

/// Alg 4 [gather] over routes of a tree that has nodes and was not stopped; incomplete if `stop`
/// ends it. A region consists of
/// the nodes whose route to the goal passes its junction first.
MapSegmentation segment_map(const Map& map, const ObstacleWeightedRrt& tree, const Routes& routes,
                            const MapSegmentationParams& params = {}, const Stop& stop = {});

}  // namespace microswarm::planning
