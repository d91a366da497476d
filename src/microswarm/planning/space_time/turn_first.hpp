// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::planning {

/// Turns of a swarm with a limited turn rate: small ones on the move, which leave it near the
/// straight way, others before it, nearly in place.
struct TurnFirst {
  static constexpr double small_turn = 0.5;   ///< [rad]
  static constexpr double slow_share = 0.02;  ///< of the speed, while it turns first

  double turn_rate = infinity;  ///< [rad/s]

  /// Whether a command of `speed` is one to turn, for a swarm of `max_speed`.
  static bool is_turn(double speed, double max_speed) {
    return speed <= 1.001 * slow_share * max_speed;
  }
  /// Whether the swarm turns by `turn` [rad] before it moves.
  bool applies(double turn) const { return std::isfinite(turn_rate) && turn > small_turn; }
  /// Time that it turns before it moves [s].
  double delay(double turn) const { return applies(turn) ? (turn - small_turn) / turn_rate : 0; }
};

}  // namespace microswarm::planning
