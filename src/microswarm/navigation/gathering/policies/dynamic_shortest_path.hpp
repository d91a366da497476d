// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"
#include "microswarm/navigation/gathering/policies/cell_graph.hpp"
#include "microswarm/navigation/gathering/policies/step_to_waypoint.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::navigation {

/// Dynamic shortest path of Becker, Fekete, Huang, Keldenich, Kleist, Krupke, Rieck and Schmidt,
/// "Targeted Drug Delivery: Algorithmic Methods for Collecting a Swarm of Particles with Uniform
/// External Forces", ICRA 2020. Of the two robots that are farthest apart by shortest path, the one
/// farther from the goal follows the shortest path to the current position of the other, until they
/// meet; then the next two, until all robots are together. Distances are those between the cells of
/// the map's cell rule or, without one, cells two steps wide.
class DynamicShortestPath {
 public:
  /// `step` [µm] is the length of a move. `patience` is the number of steps without fewer places or
  /// a shorter greatest distance after which it gives up. The map must outlive it.
  DynamicShortestPath(const AggregationMap& map, double step, double patience);

  /// Whether two robots are still to be brought together; these are then `follower()` and another.
  /// `ways` are path lengths to the goal.
  bool chases(const Robots& robots, const RobotsOnMap& on_map);
  /// Move [µm] of the follower towards the other. There must be one.
  Vec2 move(const Robots& robots);
  std::size_t follower() const { return follower_; }
  /// The robot that it follows.
  std::size_t target() const { return other_; }
  /// Point that the last move leads to.
  Vec2 waypoint() const { return step_to_.waypoint(); }
  /// Whether it gave up.
  bool gave_up() const { return gave_up_; }
  /// Takes the merging of positions: the new index of each old one.
  void remap(std::span<const std::uint32_t> new_positions);

 private:
  std::uint32_t robot_cell(const Robots& robots, std::size_t i) const;
  bool met(const Robots& robots) const;
  void choose(const Robots& robots, const RobotsOnMap& on_map);
  void note_progress(std::size_t cells, std::uint32_t distance);

  const AggregationMap* map_;
  std::shared_ptr<const CellGraph> cells_;
  double step_;
  double patience_;
  std::size_t min_cells_ = ~std::size_t{0};  ///< that held all robots when a pair was chosen
  std::uint32_t min_distance_ = 0;           ///< of a pair, with as few cells
  int since_progress_ = 0;
  bool gave_up_ = false;
  bool has_pair_ = false;
  bool together_ = false;
  std::size_t follower_ = 0;
  std::size_t other_ = 0;
  StepToWaypoint step_to_;
};

}  // namespace microswarm::navigation
