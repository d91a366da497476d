// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm {

/// Robots by place. Those in the same place move as one for ever, since all get the same input: a
/// simulation need look at each place only once, and a gathering swarm soon has few.
class MergedRobots {
 public:
  explicit MergedRobots(const Robots& robots);

  /// How many robots.
  std::size_t size() const { return place_of_.size(); }
  /// Where robot i is, in the coordinates of `places`.
  PointF place_of(std::size_t i) const {
    return {places_.x[place_of_[i]], places_.y[place_of_[i]]};
  }
  const Robots& places() const { return places_; }
  /// To be moved by a RobotStepper.
  Robots& places() { return places_; }
  /// How many robots are in each place; the sum never changes.
  std::span<const std::uint32_t> counts() const { return counts_; }

  /// Joins places that are the same, or in the same cell of a grid when `cell` [µm] is more than 0:
  /// the first one stands for all. Returns the new place of each old one, ascending where they are
  /// new; empty when nothing was joined.
  std::span<const std::uint32_t> merge_coincident(double cell = 0);
  /// Joins cells, larger and larger from `cell` [µm] on, until there are at most `most` places.
  void coarsen(std::size_t most, double cell);
  /// Where each of the robots is that it was made of, in their order.
  Robots robots() const;

 private:
  Robots places_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> place_of_;     ///< of each robot
  std::vector<std::uint32_t> merged_into_;  ///< new place of each old one
  std::vector<std::uint32_t> slots_;        ///< hash table of places
};

}  // namespace microswarm
