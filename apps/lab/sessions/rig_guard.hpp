// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "microswarm/rig/session/live_session.hpp"
#include "microswarm/rig/watch/fault.hpp"

namespace microswarm::lab {

/// Sets the coils of a rig to zero on request, or when the page with the controls is silent for too
/// long. It has its own thread, since a tick, a slow page or a slow driver must not delay it. Every
/// function may be called from any thread and, except release(), returns at once.
class RigGuard {
 public:
  using Clock = std::chrono::steady_clock;
  /// Maximum silence of the page while the coils are driven.
  static constexpr std::chrono::milliseconds patience{400};

  RigGuard() : thread_([this] { run(); }) {}
  ~RigGuard();
  RigGuard(const RigGuard&) = delete;
  RigGuard& operator=(const RigGuard&) = delete;

  /// Takes a sign of life of the page.
  void beat();
  /// Whether the last sign of life is recent.
  bool hears() const;
  /// Sets the coils to zero, also of a session that is still being opened.
  void stop(const std::string& why, rig::FaultKind kind = rig::FaultKind::person);
  /// Number of stop requests so far.
  std::uint64_t stops() const;
  /// Guards a session whose opening began after `stops` stop requests; a later one stops it. With
  /// `listens` the page must not be silent.
  /// `priority` is the real-time one of its thread from then on; 0 for none.
  void watch(std::shared_ptr<rig::LiveSession> session, bool listens, std::uint64_t stops,
             int priority = 0);
  /// Releases the session, after a stop in progress, if any.
  void release();

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<rig::LiveSession> session_;
  bool listens_ = false;
  bool is_stopping_ = false;
  bool ends_ = false;
  int priority_ = 0;
  std::uint64_t stops_ = 0;
  rig::Fault why_;                                   ///< of a pending stop
  rig::FaultKind last_kind_ = rig::FaultKind::none;  ///< of the last stop request
  Clock::time_point heard_{};
  std::thread thread_;
};

}  // namespace microswarm::lab
