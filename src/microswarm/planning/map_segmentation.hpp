// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "microswarm/core/angles.hpp"
#include "microswarm/planning/obstacle_weighted_rrt.hpp"

namespace microswarm {

/// Lengths are in widths of the local channel, so that they fit every map.
struct MapSegmentationParams {
  static constexpr std::string_view type_name = "map_segmentation";
  double eccentricity = 0.97;
  double range = 1;
  int arms = 3;
  double arm_gap = radians(20);
  double merge_distance = 0.4;
  double fill = 0.5;
  int most_branches = 4;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.eccentricity, {"eccentricity", Unit::none, {0, 1}, "delta_e: junctions have less."});
    visit(self.range, {"range", Unit::none, {0.1, 10}, "Reach of a node, in channel widths."});
    visit(self.arms, {"arms", Unit::none, {0, 10}, "Channels that meet in a junction, at least."});
    visit(self.arm_gap, {"arm_gap", Unit::deg, {0, 120}, "Least angle between two channels."});
    visit(self.merge_distance,
          {"merge_distance", Unit::none, {0, 10}, "Junction nodes nearer are one junction."});
    visit(self.fill, {"fill", Unit::none, {0, 1}, "Share of junction nodes in its middle."});
    visit(self.most_branches, {"most_branches", Unit::none, {1, 10}, "Branches of a region."});
  }
};

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
