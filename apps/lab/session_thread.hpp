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
  /// Throws InputError for settings that a page may not make.
  std::function<void(const std::vector<std::string>& settings)> check{};
};

/// A session in a thread of its own: steps it at its speed, answers requests and publishes what
/// pages show. Every function may be called from any thread; the callbacks are called in the
/// session's.
class SessionThread {
 public:
  struct Callbacks {
    /// It was opened, or why it was not: one line for each issue.
    std::function<void(const std::string& trouble)> opened;
    /// A message for one page, or for all (0). The first one for a page is its hello.
    std::function<void(std::uint64_t page, MessagePtr)> send;
  };
  SessionThread(Opening opening, Callbacks callbacks);
  /// Ends it and waits for that.
  ~SessionThread();
  SessionThread(const SessionThread&) = delete;
  SessionThread& operator=(const SessionThread&) = delete;

  /// Asks it to end; the step that is being made is told to stop.
  void end();
  bool has_ended() const { return has_ended_; }

  const std::filesystem::path& file() const { return opening_.file; }

  /// Sends the page what it needs once.
  void join(std::uint64_t page);
  void ask(std::uint64_t page, Request request);
  /// Calls `work` with the session between two ticks, in the session's thread.
  void with(std::function<void(Session&)> work);

 private:
  void run();
  void serve();
  Stop::Clock::time_point next_act(bool is_due) const;
  void open();
  void take_record();
  void answer(std::uint64_t page, const Request& request);
  void obey(const Request& request, Issues& issues);
  void operate(const Request& request, Issues& issues);
  void play();
  void restart(const Request& request);
  void set(const Request& request, Issues& issues);
  SessionView present_view() const;
  void welcome(std::uint64_t page);
  void advance();
  void take(const Tick& tick);
  void look_back(double frame, Issues& issues);
  void look_at_newest();
  void publish();
  void tell_rows();
  void tell_standing();
  const Session& shown() const { return past_ ? *past_ : *session_; }

  Opening opening_;
  Callbacks callbacks_;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::function<void()>> work_;  ///< guarded
  std::atomic<bool> ends_ = false;
  std::atomic<bool> has_ended_ = false;

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
  bool is_fresh_ = false;                ///< there is a frame to publish
  bool has_changed_ = false;             ///< how it stands is to be told
  Stop::Clock::time_point due_{};        ///< of the next tick
  Stop::Clock::time_point published_{};  ///< when a frame was sent last
  std::thread thread_;
};

}  // namespace microswarm::lab
