// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm {

/// Completes frames in which an obstacle was not found: for a while it is taken to go on as it was
/// seen to move, so that one missed detection does not open a way through it.
class ObstacleMemory {
 public:
  /// An obstacle is remembered for `memory` seconds after it was found last; 0 remembers none.
  explicit ObstacleMemory(double memory) : memory_(memory) {}

  /// The observation with the obstacles that its frame lacks after those that it has. Valid as long
  /// as `observation` and until the next call. A frame older than the last one begins anew.
  Observation complete(const Observation& observation);

 private:
  /// A body that was found last at the time `seen`.
  struct Lost {
    Body body;
    Vec2 velocity;    ///< [µm/s]
    double seen = 0;  ///< [s]
  };

  void look_for_lost(std::span<const Body> bodies, double seen);

  double memory_;
  ObstacleTracker tracker_;
  std::vector<Body> found_;  ///< in the newest frame
  std::vector<Lost> lost_;   ///< before it
};

}  // namespace microswarm
