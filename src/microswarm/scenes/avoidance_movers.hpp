// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/scenes/avoidance_grounds.hpp"

namespace microswarm::scenes {

/// An obstacle with the properties needed to check fairness.
struct Mover {
  Obstacle obstacle{};
  double extent = 0;    ///< maximum radius around its position [µm]
  bool rests = false;   ///< its position is constant
  bool passes = false;  ///< it crosses the world and leaves
};

/// Random obstacle of any shape and motion whose top speed is `speed_ratio` times the swarm's. It
/// may rest only if `may_rest`. Tracks extend to `time_limit` [s].
Mover random_mover(const Ground& ground, const Crosser& swarm, double speed_ratio, bool may_rest,
                   double time_limit, Rng& rng);
/// Lets a mover on waypoints turn at 1.5 rad/s at most: it becomes a track that extends to
/// `time_limit` [s] and passes the points at some distance.
void limit_turns(Mover& mover, double time_limit);

}  // namespace microswarm::scenes
