// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "lab/session_thread.hpp"

namespace microswarm::lab {

/// A page that watches a session, as the hub sees it. Called in the thread of input and output.
class Page {
 public:
  virtual ~Page() = default;
  virtual void send(const MessagePtr& message) = 0;
};

/// The open sessions and the pages that watch them. A session without a page for `patience` is
/// closed. All functions are called in the thread of input and output; `post` brings the sessions'
/// messages there.
class Hub {
 public:
  using Post = std::function<void(std::function<void()>)>;
  Hub(Post post, std::size_t max_sessions, std::size_t max_pages);
  ~Hub();

  /// Opens a session; `opened` gets its number, or why there is none.
  void open(Opening opening,
            std::function<void(std::uint64_t session, const std::string& trouble)> opened);
  bool has(std::uint64_t session) const;
  void close(std::uint64_t session);
  bool is_full() const { return pages_.size() >= max_pages_; }

  /// Number of the page, for leave() and ask(). The page is not owned.
  std::uint64_t join(std::uint64_t session, Page& page);
  void leave(std::uint64_t page);
  void ask(std::uint64_t page, Request request);
  /// Closes sessions that nobody has watched since the call before the last one.
  void sweep();

 private:
  struct Seat {
    std::uint64_t session;
    Page* page;
  };
  struct Running {
    std::unique_ptr<SessionThread> thread;
    bool is_open = false;
    int unwatched = 0;  ///< sweeps
  };
  void deliver(std::uint64_t session, std::uint64_t page, const MessagePtr& message);
  void settle(std::uint64_t session, const std::string& trouble);

  Post post_;
  std::size_t max_sessions_;
  std::size_t max_pages_;
  std::uint64_t next_ = 1;
  std::map<std::uint64_t, Running> sessions_;
  std::map<std::uint64_t, std::function<void(std::uint64_t, const std::string&)>> waiting_;
  std::map<std::uint64_t, Seat> pages_;
};

}  // namespace microswarm::lab
