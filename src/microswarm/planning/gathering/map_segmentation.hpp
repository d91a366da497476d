// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/angles.hpp"
#include "microswarm/planning/gathering/map_segmentation_params.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"

namespace microswarm {

/// A junction and the channels that lead to the goal by way of it.
struct Region {
  Vec2 junction;           ///< centroid of its junction nodes; the goal for region 0
  std::uint32_t node = 0;  ///< its junction node nearest to the centroid
  std::uint32_t gate = 0;  ///< its node of least cost: where robots leave it
  std::uint32_t next = 0;  ///< region entered from the gate; lower than its own number
  std::uint32_t branches = 0;
};

/// Every node belongs to one region and one branch of it. Regions are numbered by the cost of their
/// gates, so that `next` leads down to the goal's region, 0, which is its own next; the farthest
/// region that holds a robot is the one with the highest number.
struct MapSegmentation {
  std::vector<Region> regions;
  std::vector<std::uint32_t> region;          ///< ψ, one a node
  std::vector<std::uint32_t> branch;          ///< φ, one a node, from 0 in each region
  std::vector<std::uint32_t> junction_nodes;  ///< V_J, ascending
};

/// Alg 4 [gather] over routes of a tree that has nodes and was not stopped: regions are what leads
/// to the goal by way of their junctions along these routes.
MapSegmentation segment_map(const Map& map, const ObstacleWeightedRrt& tree, const Routes& routes,
                            const MapSegmentationParams& params = {});

}  // namespace microswarm
