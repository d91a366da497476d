// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lab/sessions/host.hpp"
#include "lab/sessions/limits.hpp"

namespace microswarm::lab {

/// Interface of a page that watches a session.
class Page {
 public:
  virtual ~Page() = default;
  virtual void send(const MessagePtr& message) = 0;
  /// Called when its session is closed.
  virtual void close() = 0;
};

/// A result computed from a session, or the reason of a failure.
template <class T>
struct Outcome {
  T value{};
  std::string trouble;
};

/// The open sessions and the pages that watch them. All functions are called in the thread of input
/// and output, to which `post` brings the sessions' messages. No function waits for a session.
class Hub {
 public:
  using Post = std::function<void(std::function<void()>)>;
  /// `lab` distinguishes its sessions' numbers from those of other labs; 1 to max_lab.
  Hub(Post post, const Limits& limits, std::uint64_t lab);

  /// So that the numbers are exact as floating-point numbers, in which pages keep them.
  static constexpr std::uint64_t max_lab = 1'000'000;

  const Limits& limits() const { return limits_; }

  /// Opens a session; `opened` gets its number. The session of a rig is joined if it is open. If
  /// there are too many, the oldest unwatched one is closed after it has opened.
  void open(Opening opening, std::function<void(const Outcome<std::uint64_t>&)> opened);
  bool has(std::uint64_t session) const;
  /// Whether the number is one of this lab's, open or closed.
  bool is_own(std::uint64_t session) const { return session / numbers == lab_; }
  std::uint64_t lab() const { return lab_; }
  /// One of the open sessions.
  struct Open {
    std::uint64_t session;
    std::string file;
    double newest;  ///< time of its newest frame [s]
    bool watched;
    bool changed;  ///< whether only its record can repeat it
    bool live;     ///< on a rig in real time
  };
  std::vector<Open> open_sessions() const;
  /// Source of an open session.
  const Opening& find_opening(std::uint64_t session) const {
    return sessions_.at(session).host->opening();
  }
  /// Whether it drives the coils of a rig.
  bool drives(std::uint64_t session) const { return sessions_.at(session).host->drives(); }
  /// Ends the session and closes its pages.
  void close(std::uint64_t session);
  /// Calls `make` with the session in its thread, between two ticks, then `done` with the result.
  /// An InputError of `make` and the end of the session are failures.
  template <class T>
  void fetch(std::uint64_t session, std::function<T(const experiment::Session&)> make,
             std::function<void(Outcome<T>)> done);

  bool is_full() const { return pages_.size() >= limits_.pages; }
  /// Adds a page; returns its number for leave() and ask(). The page is kept until it leaves.
  std::uint64_t join(std::uint64_t session, std::shared_ptr<Page> page);
  /// `for_good`: it was left by a person, not by a broken connection or a reload; a session that no
  /// other page watches pauses.
  void leave(std::uint64_t page, bool for_good = false);
  void ask(std::uint64_t page, Request request);

  /// Sets the coils of every rig to zero.
  void stop(const std::string& why);

  /// Pauses sessions that were unwatched since the call before the last one, and closes those that
  /// the limits no longer keep.
  void sweep();
  /// Frees ended sessions.
  void reap();
  /// Requests the end of all sessions, and releases pages and waiting callers.
  void end();
  /// Whether all sessions have ended.
  bool has_ended() const;

 private:
  struct Seat {
    std::uint64_t session;
    std::shared_ptr<Page> page;
    bool is_welcome = false;  ///< whether it got its hello; only then it gets messages for all
  };
  struct Running {
    std::unique_ptr<Host> host;
    bool is_open = false;
    int unwatched = 0;  ///< number of sweeps
  };
  struct Waiting {
    std::uint64_t session;
    std::function<void(const std::string& trouble)> settle;
  };
  bool is_watched(std::uint64_t session) const;
  bool makes_room(std::uint64_t session) const;
  using Session = std::map<std::uint64_t, Running>::iterator;
  bool goes_before(Session a, Session b) const;
  void close_unwatched();
  void close_largest();
  void deliver(std::uint64_t session, std::uint64_t page, const MessagePtr& message);
  std::uint64_t wait(std::uint64_t session, std::function<void(const std::string&)> settle);
  void settle(std::uint64_t waiting, const std::string& trouble);

  Post post_;
  Limits limits_;
  static constexpr std::uint64_t numbers = 1'000'000'000;  ///< of a lab
  std::uint64_t lab_;
  std::uint64_t next_ = lab_ * numbers + 1;
  std::map<std::uint64_t, Waiting> waiting_;
  std::map<std::uint64_t, Seat> pages_;
  std::map<std::uint64_t, Running> sessions_;
  std::list<std::unique_ptr<Host>> closing_;
};

template <class T>
void Hub::fetch(std::uint64_t session, std::function<T(const experiment::Session&)> make,
                std::function<void(Outcome<T>)> done) {
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return done({.trouble = "there is no such session"});
  const auto value = std::make_shared<T>();
  const std::uint64_t number =
      wait(session, [value, done = std::move(done)](const std::string& trouble) {
        done({.value = std::move(*value), .trouble = trouble});
      });
  found->second.host->with([this, number, value, make = std::move(make)](experiment::Session& of) {
    std::string trouble;
    try {
      *value = make(of);
    } catch (const std::exception& error) {
      trouble = error.what();
    }
    post_([this, number, trouble] { settle(number, trouble); });
  });
}

}  // namespace microswarm::lab
