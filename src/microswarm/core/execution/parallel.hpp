// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace microswarm {

/// Threads that sleep between loops, for many short loops that follow one another. A build without
/// threads (MICROSWARM_THREADS) runs each loop in the caller's.
class ThreadTeam {
 public:
  /// `jobs` threads (0: one per core), including the caller's: with 1 there is no other.
  explicit ThreadTeam(int jobs);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Calls `body(i)` once for each i in 0 … count−1, and returns when all calls have. Each thread
  /// takes the next i when it is free; a thread that does not wake up in time takes none. If a call
  /// throws, no further call starts and one of the exceptions is rethrown. One loop at a time.
  void for_each_index(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

/// The same with temporary threads. `jobs` is the number of threads, 0: one per core.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body);

}  // namespace microswarm
