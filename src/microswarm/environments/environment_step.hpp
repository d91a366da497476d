// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm {

/// Result of a step of an environment for learning.
struct EnvironmentStep {
  double reward = 0;
  bool terminated = false;  ///< the episode has come to its own end
  bool truncated = false;   ///< its time has run out
};

}  // namespace microswarm
