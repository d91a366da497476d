// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::navigation {

/// Robots grouped by position. Robots at the same position stay together, since all receive the
/// same input. A simulation therefore handles each position once, and a gathering swarm soon has
/// few.
class MergedRobots {
 public:
  explicit MergedRobots(const Robots& robots);

  /// Number of robots.
  std::size_t size() const { return place_of_.size(); }
  /// Position of robot i, in the coordinates of `positions`.
  PointF position(std::size_t i) const {
    return {positions_.x[place_of_[i]], positions_.y[place_of_[i]]};
  }
  const Robots& positions() const { return positions_; }
  /// Positions, to be moved by a RobotStepper.
  Robots& positions() { return positions_; }
  /// Number of robots at each position; the sum is constant.
  std::span<const std::uint32_t> counts() const { return counts_; }

  /// Merges equal positions or, if `cell` [µm] is above 0, positions in the same grid cell; the
  /// first one represents all. Returns the new index of each old position, ascending for those
  /// kept; empty if nothing was merged.
  std::span<const std::uint32_t> merge_coincident(double cell = 0);
  /// Merges cells, doubling their size from `cell` [µm], until at most `most` positions remain.
  void coarsen(std::size_t most, double cell);
  /// The distinct positions as robots, with their counts.
  MergedRobots condensed() const;
  /// Positions of the original robots, in their order.
  Robots robots() const;

 private:
  Robots positions_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> place_of_;     ///< of each robot
  std::vector<std::uint32_t> merged_into_;  ///< new index of each old position
  std::vector<std::uint32_t> slots_;        ///< hash table of positions
};

}  // namespace microswarm::navigation
