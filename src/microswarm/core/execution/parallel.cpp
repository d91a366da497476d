// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/parallel.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace microswarm {
namespace {

std::size_t thread_count(int jobs) {
  return jobs > 0 ? static_cast<std::size_t>(jobs)
                  : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace

/// The loop that is run, and the threads that help.
class ThreadTeam::Loop {
 public:
  explicit Loop(std::size_t threads);
  ~Loop() { end(); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void run(std::size_t count, const std::function<void(std::size_t)>& body);

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

ThreadTeam::Loop::Loop(std::size_t threads) {
  try {
    for (std::size_t i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
  } catch (...) {
    end();
    throw;
  }
}

void ThreadTeam::Loop::end() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  may_help_.notify_all();
}

void ThreadTeam::Loop::run(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::unique_lock lock(mutex_);
  body_ = &body;
  next_ = 0;
  count_ = count;
  if (count > 1) may_help_.notify_all();
  take_calls(lock);
  returned_.wait(lock, [this] { return running_ == 0; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void ThreadTeam::Loop::help() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    take_calls(lock);
    may_help_.wait(lock, [this] { return ends_ || next_ < count_; });
  }
}

// Holds the lock except during a call.
void ThreadTeam::Loop::take_calls(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t i = next_++;
    ++running_;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      (*body_)(i);
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    --running_;
    if (thrown) {
      thrown_ = thrown;
      next_ = count_;
    }
  }
  if (running_ == 0) returned_.notify_one();
}

ThreadTeam::ThreadTeam(int jobs) : loop_(std::make_unique<Loop>(thread_count(jobs))) {}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::for_each_index(std::size_t count, const std::function<void(std::size_t)>& body) {
  loop_->run(count, body);
}

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body) {
  ThreadTeam(static_cast<int>(std::min(thread_count(jobs), std::max<std::size_t>(1, count))))
      .for_each_index(count, body);
}

}  // namespace microswarm
