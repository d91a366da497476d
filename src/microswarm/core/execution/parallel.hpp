// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace microswarm {

/// Threads that sleep between loops, for many short loops that follow one another.
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
  void help();
  void end();
  void take_calls(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable may_help_;
  std::condition_variable returned_;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::size_t running_ = 0;  ///< calls that have not returned
  bool ends_ = false;
  std::exception_ptr thrown_;
  std::vector<std::jthread> helpers_;
};

/// The same with temporary threads. `jobs` is the number of threads, 0: one per core.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body);

}  // namespace microswarm
