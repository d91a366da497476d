// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm::environments {

/// Result of a step of an environment for learning.
struct EnvironmentStep {
  double reward = 0;
  bool terminated = false;  ///< whether the episode has ended by its rules
  bool truncated = false;   ///< whether its time limit is reached
};

}  // namespace microswarm::environments
