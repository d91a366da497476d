// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "microswarm/core/status.hpp"

namespace microswarm {

/// When to give up: a flag somebody else may set (Ctrl-C), and a deadline. Both are optional, and
/// an empty Stop never stops. Library code asks it at least once per millisecond of work.
class Stop {
 public:
  using Clock = std::chrono::steady_clock;

  Stop() = default;
  explicit Stop(const std::atomic<bool>* flag) : flag_(flag) {}
  explicit Stop(Clock::duration budget, const std::atomic<bool>* flag = nullptr)
      : flag_(flag), deadline_(Clock::now() + budget) {}

  /// Somebody asked to stop.
  bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// The deadline has passed.
  bool expired() const { return deadline_ && Clock::now() >= *deadline_; }
  bool operator()() const { return requested() || expired(); }
  /// What ends work now: `stopped`, `time_limit` or nothing.
  std::optional<Status> status() const {
    if (requested()) return Status::stopped;
    if (expired()) return Status::time_limit;
    return std::nullopt;
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
  std::optional<Clock::time_point> deadline_;
};

/// What has gone by [s].
inline double seconds_since(Stop::Clock::time_point began) {
  return std::chrono::duration<double>(Stop::Clock::now() - began).count();
}

}  // namespace microswarm
