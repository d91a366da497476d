// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <functional>
#include <string>
#include <utility>

#include "microswarm/core/execution/clock.hpp"

namespace microswarm {

/// Notices that the program was stopped or the computer was suspended, wherever it was then: what
/// is commanded after it may be stale. A test passes another clock.
class Standstill {
 public:
  /// `most` [s] is allowed. `suspended` gives the time for which the computer was suspended [s].
  explicit Standstill(double most, std::function<double()> suspended = suspended_seconds)
      : most_(most), clock_(std::move(suspended)), at_(steady_seconds()), suspended_(clock_()) {}

  /// The time since the last call was meant to take `seconds` at most. Returns what happened, or an
  /// empty string. A suspension since the construction is never forgotten.
  std::string pass(double seconds) {
    const double asleep = clock_() - suspended_;
    const double late = steady_seconds() - std::exchange(at_, steady_seconds()) - seconds;
    if (asleep > most_) return fmt::format("the computer was suspended for {:.2g} s", asleep);
    return late > most_ ? fmt::format("the program stood still for {:.2g} s", late) : "";
  }

 private:
  double most_;
  std::function<double()> clock_;
  double at_;
  double suspended_;
};

}  // namespace microswarm
