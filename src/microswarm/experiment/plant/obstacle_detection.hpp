// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/plant/dropouts.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Obstacles as a camera and its image processing find them: with noise, not in every frame, and
/// now and then with the identity of a neighbour.
class ObstacleDetection {
 public:
  ObstacleDetection(const SensingParams& params, Rng rng)
      : params_(params), rng_(rng), dropouts_(params.obstacle_missed_share, params.missed_time) {}

  /// The world at time `taken`, which the frame states as `told` [s], `dt` [s] after the frame
  /// before. Bodies of one obstacle share noise, misses and identity.
  Snapshot frame(const World& world, double taken, double told, double dt);

 private:
  void swap_identities(const World& world, std::vector<Body>& bodies);

  SensingParams params_;
  Rng rng_;
  Dropouts dropouts_;
};

}  // namespace microswarm::experiment
