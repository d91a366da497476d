// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_params.hpp"
#include "microswarm/navigation/gathering/policies/cell_graph.hpp"
#include "microswarm/planning/gathering/map_segmentation.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::navigation {

/// Motion of robots under one input.
enum class MoveRule {
  any_direction,  ///< in any direction up to a step, until they meet a wall [gather]
  cells,  ///< to a neighbouring cell, one of eight, if that is free; past corners too. Cells are a
          ///< step wide: the rules of the set gym-gathering (Konitzny, Lu, Leclerc, Fekete and
          ///< Becker, IROS 2022).
};

/// Map data of an aggregation: the tree with its routes to the goal, and the regions along them.
/// Built once and shared by all robots.
struct AggregationMap {
  Map map{};
  planning::ObstacleWeightedRrt tree{};
  bool obstacle_weighted;  ///< which of the tree's routes are used
  planning::MapSegmentation segmentation{};
  double longest = 0;                        ///< longest path to the goal along the routes [µm]
  std::shared_ptr<const CellGraph> cells{};  ///< by the cell rule, else null
  std::vector<std::uint32_t> hops{};         ///< by the cell rule: from each cell to the goal

  bool was_stopped = false;  ///< then it is incomplete

  const planning::Routes& routes() const { return obstacle_weighted ? tree.weighted : tree.plain; }

  /// Throws InputError if the goal is not free or the tree could not be grown.
  AggregationMap(Map map, Vec2 goal, const AggregationParams& params, Rng& rng,
                 MoveRule rule = MoveRule::any_direction, const Stop& stop = {});

  /// Path length [µm] from `p` to the goal, where `node` is the one nearest to `p`.
  double length_from(Vec2 p, std::uint32_t node) const {
    if (cells) return hops[cells->at(p)] * cells->unit();
    return routes().length[node] + distance(p, tree.nodes[node]);
  }
  /// By the cell rule: the next cell's centre on the shortest path from `p` to the goal.
  Vec2 next_cell(Vec2 p) const { return (*cells)[cells->towards(hops, cells->at(p))]; }
};

/// Robots as input of an aggregation.
struct RobotsOnMap {
  std::vector<std::uint32_t> counts{};  ///< robots at each position; empty: one each
  std::vector<std::uint32_t> nodes{};   ///< nearest node of each position
  std::vector<double> lengths{};        ///< path length to the goal from each position [µm]

  /// Number of robots at a position.
  double count(std::size_t i) const { return counts.empty() ? 1 : static_cast<double>(counts[i]); }
};

/// Rounds to 2^-20, so that sums are exact and independent of the order of the robots.
inline double on_lattice(double v) {
  constexpr double shift = 0x1.8p32;
  return (v + shift) - shift;
}

}  // namespace microswarm::navigation
