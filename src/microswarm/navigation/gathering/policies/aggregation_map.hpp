// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_params.hpp"
#include "microswarm/planning/gathering/map_segmentation.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Map data of an aggregation: the tree with its routes to the goal, and the regions along them.
/// Built once and shared by all robots.
struct AggregationMap {
  Map map;
  ObstacleWeightedRrt tree;
  bool obstacle_weighted;  ///< which of the tree's routes are used
  MapSegmentation segmentation;

  const Routes& routes() const { return obstacle_weighted ? tree.weighted : tree.plain; }

  /// Throws InputError if the goal is not free or the tree could not be grown.
  AggregationMap(Map map, Vec2 goal, const AggregationParams& params, Rng& rng);
};

/// Robots as input of an aggregation.
struct RobotsOnMap {
  std::vector<std::uint32_t> counts;  ///< robots at each position; empty: one each
  std::vector<std::uint32_t> nodes;   ///< nearest node of each position
  std::vector<double> ways;           ///< path length to the goal from each position [µm]

  double count(std::size_t i) const { return counts.empty() ? 1 : static_cast<double>(counts[i]); }
};

/// Rounds to 2^-20, so that sums are exact and independent of the order of the robots.
inline double on_lattice(double v) {
  constexpr double shift = 0x1.8p32;
  return (v + shift) - shift;
}

}  // namespace microswarm
