// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>

#include "microswarm/contracts/command.hpp"

namespace microswarm {

/// Delay line of commands: each takes effect `lag` seconds after it was given. Holds until the
/// first one takes effect.
class LaggingCommands {
 public:
  explicit LaggingCommands(double lag) : lag_(lag) {}

  /// Adds a command and advances time by `dt` seconds. Calls `act(command, seconds)` for the
  /// commands in effect, in pieces of at most `longest` seconds.
  template <class Act>
  void pass(const Command& command, double dt, double longest, Act&& act) {
    pending_.push_back({command, lag_});
    for (double passed = 0; dt - passed > same_moment;) {
      while (!pending_.empty() && pending_.front().due <= same_moment) {
        active_ = pending_.front().command;
        pending_.pop_front();
      }
      const double until_next = pending_.empty() ? dt : pending_.front().due;
      const double piece = std::min({longest, dt - passed, until_next});
      act(active_, piece);
      for (Pending& p : pending_) p.due -= piece;
      passed += piece;
    }
  }

 private:
  // Times closer than this are equal: sums of ticks and lags are not exact.
  static constexpr double same_moment = 1e-9;
  struct Pending {
    Command command;
    double due;  // [s] from now
  };
  double lag_;
  Command active_;
  std::deque<Pending> pending_;
};

}  // namespace microswarm
