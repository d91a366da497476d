// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lab/request.hpp"
#include "lab/stream.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm::lab {

/// What a session is opened from.
struct Opening {
  std::filesystem::path file;  ///< scenario or record
  SessionOptions options{};
};

/// A session in a thread of its own: steps it at its speed, answers requests and publishes what
/// pages show. Every function may be called from any thread; the callbacks are called in the
/// session's.
class SessionThread {
 public:
  struct Callbacks {
    /// It was opened, or why it was not: one line for each issue.
    std::function<void(const std::string& trouble)> opened;
    /// A message for one page, or for all that joined (0).
    std::function<void(std::uint64_t page, MessagePtr)> send;
  };
  SessionThread(Opening opening, Callbacks callbacks);
  /// Ends it, at the latest after the step that is being made was told to stop.
  ~SessionThread();
  SessionThread(const SessionThread&) = delete;
  SessionThread& operator=(const SessionThread&) = delete;

  /// A page that gets all messages from now on, beginning with what it needs once.
  void join(std::uint64_t page);
  void ask(std::uint64_t page, Request request);
  /// Calls `work` with the session between two ticks, in the session's thread.
  void with(std::function<void(Session&)> work);

 private:
  struct Work;
  void run();
  void open();
  void answer(std::uint64_t page, const Request& request);
  Issues obey(const Request& request);
  void welcome(std::uint64_t page);
  void tell_scenario(std::uint64_t page);
  void advance();
  void take(const Tick& tick);
  void look_back(std::size_t frame);
  void publish(bool at_once);
  void tell_standing();
  const Session& shown() const { return past_ ? *past_ : *session_; }

  Opening opening_;
  Callbacks callbacks_;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::function<void()>> work_;  ///< guarded
  std::atomic<bool> ended_ = false;

  // Of the thread alone.
  std::unique_ptr<Session> session_;
  std::unique_ptr<Session> past_;  ///< of what was recorded so far, while one looks back
  Standing standing_;
  std::vector<Row> rows_;
  std::vector<RunEvent> events_;
  std::size_t told_rows_ = 0;
  std::size_t told_events_ = 0;
  std::uint64_t told_plans_ = 0;
  bool told_aggregation_ = false;
  bool is_fresh_ = false;  ///< there is something to publish
  Stop::Clock::time_point due_{};        ///< of the next tick
  Stop::Clock::time_point published_{};  ///< when a frame was sent last
  std::thread thread_;
};

}  // namespace microswarm::lab
