// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "microswarm/core/execution/status.hpp"

namespace microswarm {

/// Stop condition: a flag set elsewhere (Ctrl-C) and a deadline. Both are optional, and an empty
/// Stop never stops. Library code polls it at least once per millisecond of work.
class Stop {
 public:
  using Clock = std::chrono::steady_clock;

  Stop() = default;
  explicit Stop(const std::atomic<bool>* flag) : flag_(flag) {}
  explicit Stop(Clock::duration budget, const std::atomic<bool>* flag = nullptr)
      : flag_(flag), deadline_(Clock::now() + budget) {}

  /// Whether the flag is set.
  bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Whether the deadline has passed.
  bool expired() const { return deadline_ && Clock::now() >= *deadline_; }
  bool operator()() const { return requested() || expired(); }
  /// Reason to end work now: `stopped`, `time_limit` or nothing.
  std::optional<Status> status() const {
    if (requested()) return Status::stopped;
    if (expired()) return Status::time_limit;
    return std::nullopt;
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
  std::optional<Clock::time_point> deadline_;
};

/// Elapsed time [s].
inline double seconds_since(Stop::Clock::time_point began) {
  return std::chrono::duration<double>(Stop::Clock::now() - began).count();
}

}  // namespace microswarm
