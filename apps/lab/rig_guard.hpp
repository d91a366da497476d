// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "microswarm/session/live_session.hpp"

namespace microswarm::lab {

/// Sets the coils of a rig to zero when it is told to, or when the page that has the controls says
/// nothing for too long. It has a thread of its own, since a tick, a slow page or a slow driver
/// must not delay it. Every function may be called from any thread and returns at once, but
/// release().
class RigGuard {
 public:
  using Clock = std::chrono::steady_clock;
  /// Longest silence of the page while the coils are driven.
  static constexpr std::chrono::milliseconds patience{400};

  RigGuard() : thread_([this] { run(); }) {}
  ~RigGuard();
  RigGuard(const RigGuard&) = delete;
  RigGuard& operator=(const RigGuard&) = delete;

  /// The page said something.
  void beat();
  /// It said something lately.
  bool hears() const;
  /// Sets the coils to zero, also those of a session that is only being opened.
  void stop(const std::string& why);
  /// How often it was told to stop so far.
  std::uint64_t stops() const;
  /// Guards a session that was opened after so many stops; one that came since then stops it. With
  /// `listens` the page must not be silent.
  void watch(std::shared_ptr<LiveSession> session, bool listens, std::uint64_t stops);
  /// Lets go of the session, after the stop that is being made, if any.
  void release();

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<LiveSession> session_;
  bool listens_ = false;
  bool is_stopping_ = false;
  bool ends_ = false;
  std::uint64_t stops_ = 0;
  std::string why_;  ///< of a stop that is still to be made
  Clock::time_point heard_{};
  std::thread thread_;
};

}  // namespace microswarm::lab
