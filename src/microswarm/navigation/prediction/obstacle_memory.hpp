// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm::navigation {

/// Completes frames in which an obstacle was not detected: for a while it is extrapolated at its
/// estimated velocity, so that one missed detection does not open a path through it.
class ObstacleMemory {
 public:
  /// Remembers an obstacle for `memory` seconds after its last detection; 0 disables this.
  explicit ObstacleMemory(double memory) : memory_(memory) {}

  /// The observation with missing obstacles appended to the detected ones. Valid as long as
  /// `observation` and until the next call. A frame older than the last one resets the memory.
  Observation complete(const Observation& observation);

 private:
  /// Body last detected at the time `seen`.
  struct Lost {
    Body body;
    Vec2 velocity;    ///< [µm/s]
    double seen = 0;  ///< [s]
  };

  void look_for_lost(std::span<const Body> bodies, double seen);

  double memory_;
  ObstacleTracker tracker_;
  std::vector<Body> found_;  ///< detected in the newest frame
  std::vector<Lost> lost_;   ///< detected before, missing now
};

}  // namespace microswarm::navigation
