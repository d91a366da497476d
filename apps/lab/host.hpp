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

#include "lab/publisher.hpp"
#include "lab/request.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm::lab {

/// How the coils of a rig may be driven in real time, as by the options of `rig run`.
struct RigOpening {
  std::filesystem::path out{};  ///< gets a folder for each run that drives the coils; empty: none
  bool without_limits = false;
  bool coils_cold = false;
  bool drawn_swarm = false;
};

/// What a session is opened from.
struct Opening {
  std::filesystem::path file;  ///< scenario or record
  SessionOptions options{};
  /// Throws InputError for settings that a page may not make.
  std::function<void(const std::vector<std::string>& settings)> check{};
  std::optional<BackgroundPhoto> photo{};
  std::optional<RigOpening> live{};  ///< on the rig in real time; else in simulated time
};
Source source_of(const Opening& opening);

/// A session in a thread of its own. Every function may be called from any thread; the callbacks
/// are called in the session's.
class Host {
 public:
  struct Callbacks {
    /// It was opened, or why it was not: one line for each issue.
    std::function<void(const std::string& trouble)> opened;
    /// A message for one page, or for all (0). The first one for a page is its hello.
    Publisher::Send send;
  };
  virtual ~Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Asks it to end; the step that is being made is told to stop.
  virtual void end();
  bool has_ended() const { return has_ended_; }
  const Opening& opening() const { return opening_; }

  /// Sends the page what it needs once.
  virtual void join(std::uint64_t page);
  virtual void leave(std::uint64_t page);
  virtual void ask(std::uint64_t page, Request request);
  /// Whether it drives the coils of a rig, and has no time for anything else.
  virtual bool drives() const { return false; }
  /// Sets the coils of a rig to zero, if it drives some.
  virtual void stop(const std::string& why);
  /// Calls `work` with the session between two ticks, in the session's thread.
  void with(std::function<void(Session&)> work);

 protected:
  using Clock = Stop::Clock;

  Host(Opening opening, Callbacks callbacks);
  /// Begins the thread; the last act of a constructor.
  void begin();
  /// Ends it and waits for that; the first act of a destructor.
  void finish();
  /// Calls `work` in the session's thread.
  void later(std::function<void()> work);
  /// Does what was asked for until then, at once if it is past. Waits for more if there is no time.
  void work_until(std::optional<Clock::time_point> latest);
  void answer(std::uint64_t page, const Request& request);
  /// Puts the operation of a person into effect.
  void operate(const Request& request, Issues& issues);

  // In the session's thread.
  virtual void open() = 0;
  /// What was asked and the tick that is due.
  virtual void serve() = 0;
  virtual Session& session() = 0;
  virtual void welcome(std::uint64_t page) = 0;
  virtual void obey(std::uint64_t page, const Request& request, Issues& issues) = 0;
  /// A step threw an exception.
  virtual void fail(const std::string& why);
  /// The thread is about to end.
  virtual void close() {}
  /// Shows an earlier frame; the session stands meanwhile, unless it is a record.
  void look_back(double frame, Issues& issues);
  void look_at_newest();
  bool looks_back() const { return past_ != nullptr; }
  /// What is looked at.
  const Session& shown() { return past_ ? *past_ : session(); }

  Opening opening_;
  Callbacks callbacks_;
  Publisher publisher_;
  std::atomic<bool> ends_ = false;

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::function<void()>> work_;  ///< guarded
  std::atomic<bool> has_ended_ = false;
  std::unique_ptr<Session> past_;  ///< of what was recorded so far, while one looks back
  std::thread thread_;
};

/// Opens it in its thread.
std::unique_ptr<Host> make_host(Opening opening, Host::Callbacks callbacks);

}  // namespace microswarm::lab
