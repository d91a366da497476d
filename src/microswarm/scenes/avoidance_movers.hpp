// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/scenes/avoidance_grounds.hpp"

namespace microswarm::scenes {

/// An obstacle, and what the rules of a fair world ask about it.
struct Mover {
  Obstacle obstacle;
  double extent = 0;    ///< greatest radius around its position [µm]
  bool rests = false;   ///< its position never moves
  bool passes = false;  ///< it comes through and is gone
};

/// Any shape on any motion, its top speed a given share of the swarm's; `rests` only where
/// `may_rest`. Tracks reach to `time_limit` [s].
Mover random_mover(const Ground& ground, const Crosser& swarm, double speed_ratio, bool may_rest,
                   double time_limit, Rng& rng);

}  // namespace microswarm::scenes
