// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lab/sessions/past.hpp"
#include "lab/stream/publisher.hpp"
#include "lab/stream/request.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/params/rig_session_options.hpp"

namespace microswarm::lab {

/// Options for driving the coils of a rig in real time, as those of `rig run`.
struct RigOpening {
  std::filesystem::path
      out{};  ///< parent of the folders of runs that drive the coils; empty for none
  bool without_limits = false;
  /// The coils are at ambient temperature; said for one run of all sessions.
  std::shared_ptr<std::atomic<bool>> coils_cold = std::make_shared<std::atomic<bool>>(false);
  bool drawn_swarm = false;
  int priority = 0;  ///< real-time one of what stops the coils; 0 for none
  /// Called in the coils' thread after each output of a run that drives them.
  std::function<void()> driven{};
  /// Called after such a run with its fault, if any, when the coils are at zero.
  std::function<void(const std::string& fault)> ended = [](const std::string&) {};
  /// Takes a line for the operator, from any thread.
  std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// A run that is repeated up to a frame, from which it continues with these changes.
struct Branch {
  std::shared_ptr<const experiment::Record> record;
  std::size_t frame = 0;
  std::vector<std::string> changes{};  ///< KEY=VALUE
};

/// Source of a session.
struct Opening {
  std::filesystem::path file;  ///< scenario or record
  rig::RigSessionOptions options{};
  /// Throws InputError for settings that are not allowed to a page.
  std::function<void(const Settings& settings)> check{};
  std::optional<BackgroundPhoto> photo{};
  std::optional<Branch> branch{};    ///< taken when it is opened
  std::optional<RigOpening> live{};  ///< options for real time; without them in simulated time
};
Source to_source(const Opening& opening);

/// A session in its own thread. Every function may be called from any thread; callbacks are called
/// in the session's thread. In a build without threads the caller's turn() is that thread.
class Host {
 public:
  struct Callbacks {
    /// Called after opening; `trouble` is empty, or has a line for each issue.
    std::function<void(const std::string& trouble)> opened;
    /// Sends a message to one page, or to all (0). The first one for a page is its hello.
    Publisher::Send send;
  };
  virtual ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Requests the end and stops the step in progress.
  virtual void end();
  bool has_ended() const { return has_ended_; }
  /// Only without threads: does what is asked and due. Returns the time at which to call it again,
  /// or nothing if only a request makes that necessary.
  std::optional<Stop::Clock::time_point> turn();
  const Opening& opening() const { return opening_; }

  /// Sends the full state to a new page.
  virtual void join(std::uint64_t page);
  virtual void leave(std::uint64_t page);
  virtual void ask(std::uint64_t page, Request request);
  /// Whether it drives the coils of a rig, and must not be delayed.
  virtual bool drives() const { return false; }
  /// Pauses what nobody watches.
  virtual void rest() {}
  /// Approximate memory of its record [B], and the time of its newest frame [s].
  std::size_t bytes() const { return bytes_; }
  double newest() const { return newest_; }
  /// Whether it was changed or steered, so that only its record can repeat it.
  bool is_changed() const { return is_changed_; }
  /// Sets the coils of its rig to zero, if any.
  virtual void stop(const std::string& why);
  /// Calls `work` with the session between two ticks, in the session's thread.
  void with(std::function<void(experiment::Session&)> work);

 protected:
  using Clock = Stop::Clock;

  Host(Opening opening, Callbacks callbacks);
  /// Starts the thread; to be called at the end of a constructor.
  void begin();
  /// Ends the thread and waits for it; to be called at the start of a destructor.
  void finish();
  /// Calls `work` in the session's thread.
  void later(std::function<void()> work);
  /// Runs queued work until `latest`; without a deadline, waits for work.
  void work_until(std::optional<Clock::time_point> latest);
  void answer(std::uint64_t page, const Request& request);
  /// Applies a request for manual operation.
  void operate(const Request& request, Issues& issues);

  // Called in the session's thread.
  virtual void open() = 0;
  /// Handles requests and the tick that is due.
  virtual void serve() = 0;
  virtual experiment::Session& session() = 0;
  virtual void welcome(std::uint64_t page) = 0;
  virtual void obey(std::uint64_t page, const Request& request, Issues& issues) = 0;
  /// Handles an exception of a step.
  virtual void fail(const std::string& why);
  /// Called before the thread ends.
  virtual void close() {}
  /// Shows an earlier frame; the session is paused meanwhile, unless it is a record.
  void look_back(double frame, Issues& issues);
  void look_at_newest();
  bool looks_back() const { return past_ != nullptr; }
  /// Keeps parts of a tick of the run, for looking back.
  void keep(const experiment::Tick& tick, const experiment::Session& of);
  /// Session that is shown.
  const experiment::Session& shown() { return past_ ? *past_ : session(); }

  Opening opening_;
  Callbacks callbacks_;
  Publisher publisher_;
  Past kept_;
  std::atomic<bool> ends_ = false;
  std::atomic<std::size_t> bytes_ = 0;
  std::atomic<double> newest_ = 0;
  std::atomic<bool> is_changed_ = false;

 private:
  class Queue;
  void start();
  void serve_once();

  std::atomic<bool> has_ended_ = false;
  std::unique_ptr<experiment::Session>
      past_;  ///< playback of the record so far, while an earlier frame is shown
  std::unique_ptr<Queue> queue_;  ///< of work, and the thread that does it
};

}  // namespace microswarm::lab
