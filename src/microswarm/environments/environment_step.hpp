// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace microswarm::environments {

/// Result of a step of an environment for learning.
struct EnvironmentStep {
  double reward = 0;
  bool terminated = false;    ///< whether the episode has ended by its rules
  bool truncated = false;     ///< whether its time limit is reached
  bool success = false;       ///< whether it has ended as it should
  std::string_view reason{};  ///< why it has ended, in one word; empty while it continues

  bool has_ended() const { return terminated || truncated; }
};

}  // namespace microswarm::environments
