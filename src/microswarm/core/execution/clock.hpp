// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace microswarm {

/// Current time of the monotonic clock [s].
inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace microswarm
