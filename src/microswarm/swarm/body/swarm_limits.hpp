// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm {

/// What a navigator is told of a swarm that is seen as one body.
struct SwarmLimits {
  double radius = 0;     ///< the greatest it gets [µm]
  double max_speed = 0;  ///< [µm/s]
  double max_turn_rate =
      0;                    ///< [rad/s]; infinite for a swarm that moves into any direction at once
  double response_lag = 0;  ///< dead time from a command to its effect [s]
  double radius_variation = 0;  ///< by how much its radius may be less [µm]
};

}  // namespace microswarm
