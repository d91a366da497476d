// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <functional>
#include <string>
#include <utility>

#include "microswarm/core/execution/clock.hpp"

namespace microswarm::rig {

/// Detects a stopped process or suspended machine; later commands may be stale. Tests pass another
/// clock.
class Standstill {
 public:
  /// `most`: longest allowed standstill [s]. `suspended` returns the total time of suspension [s].
  explicit Standstill(double most, std::function<double()> suspended = suspended_seconds)
      : max_pause_(most),
        clock_(std::move(suspended)),
        at_(steady_seconds()),
        suspended_(clock_()) {}

  /// To be called when at most `seconds` should have passed since the last call. Returns what
  /// happened, or an empty string. A suspension since the construction is always reported.
  std::string pass(double seconds) {
    const double asleep = clock_() - suspended_;
    const double late = steady_seconds() - std::exchange(at_, steady_seconds()) - seconds;
    if (asleep > max_pause_) return fmt::format("the computer was suspended for {:.2g} s", asleep);
    return late > max_pause_ ? fmt::format("the program stood still for {:.2g} s", late) : "";
  }

 private:
  double max_pause_;
  std::function<double()> clock_;
  double at_;
  double suspended_;
};

}  // namespace microswarm::rig
