// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

#include <chrono>

namespace microswarm {

/// Current time of the monotonic clock [s].
inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Time for which the computer was suspended since it was started [s]; the monotonic clock stands
/// still meanwhile.
inline double suspended_seconds() {
  const auto now = [](clockid_t clock) {
    timespec t{};
    ::clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double monotonic = now(CLOCK_MONOTONIC);
  return now(CLOCK_BOOTTIME) - monotonic;
}

}  // namespace microswarm
