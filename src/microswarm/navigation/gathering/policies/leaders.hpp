// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"

namespace microswarm::navigation {

/// The robot farthest from the goal, the first of several.
std::size_t farthest_robot(const RobotsOnMap& robots);

/// Leader of Alg 3 [gather], HRA: the farthest robot, until it is less than two steps [µm] from the
/// goal. `last` was the leader until now, ~0 at first.
std::size_t heuristic_leader(const RobotsOnMap& robots, std::size_t last, double step);

/// The same with a random robot in place of the farthest one: out of a livelock. Independent of how
/// positions are merged.
std::size_t random_leader(const RobotsOnMap& robots, std::size_t last, double step, Rng& rng);

/// Detects a livelock: the mean distance to the goal has had no new minimum for `patience` steps.
/// Once detected, it remains.
class LivelockGuard {
 public:
  /// Progress is counted in shares of `sigma` [µm].
  LivelockGuard(double patience, double sigma) : patience_(patience), sigma_(sigma) {}

  /// Takes the mean distance [µm] of a step. True from the livelock on.
  bool update(double mean_distance);
  bool is_livelock() const { return is_livelock_; }

 private:
  double patience_;
  double sigma_;
  double best_ = infinity;
  int since_best_ = 0;
  bool is_livelock_ = false;
};

}  // namespace microswarm::navigation
