// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm {

/// Properties of a single-body swarm that navigators know.
struct SwarmLimits {
  double radius = 0;         ///< maximum [µm]
  double max_speed = 0;      ///< [µm/s]
  double max_turn_rate = 0;  ///< [rad/s]; infinite for a swarm that moves in any direction at once
  double response_lag = 0;   ///< dead time from a command to its effect [s]
  double radius_variation = 0;  ///< maximum minus minimum radius [µm]
};

}  // namespace microswarm
