// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/rng.hpp"
#include "microswarm/navigation/gathering/aggregation_params.hpp"
#include "microswarm/planning/gathering/map_segmentation.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// What an aggregation knows of its map: the tree with its ways to the goal, and the regions along
/// them. Made once, shared by all that gather there.
struct AggregationMap {
  Map map;
  ObstacleWeightedRrt tree;
  bool obstacle_weighted;  ///< which of the tree's routes are used
  MapSegmentation segmentation;

  const Routes& routes() const { return obstacle_weighted ? tree.weighted : tree.plain; }

  /// Throws InputError when the goal is not free or the tree could not be grown.
  AggregationMap(Map map, Vec2 goal, const AggregationParams& params, Rng& rng);
};

/// Robots as an aggregation sees them.
struct RobotsOnMap {
  std::vector<std::uint32_t> counts;  ///< robots in each place; empty: one
  std::vector<std::uint32_t> nodes;   ///< nearest node of each place
  std::vector<double> ways;           ///< way to the goal of each place [µm]

  double count(std::size_t i) const { return counts.empty() ? 1 : static_cast<double>(counts[i]); }
};

/// Rounded to 2^-20: sums are exact, so that they do not depend on the order of the robots.
inline double on_lattice(double v) {
  constexpr double shift = 0x1.8p32;
  return (v + shift) - shift;
}

}  // namespace microswarm
