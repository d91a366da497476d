// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/parallel.hpp"

#include <algorithm>
#include <utility>

namespace microswarm {
namespace {

std::size_t thread_count(int jobs) {
  return jobs > 0 ? static_cast<std::size_t>(jobs)
                  : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace

ThreadTeam::ThreadTeam(int jobs) {
  try {
    for (std::size_t i = 1; i < thread_count(jobs); ++i) helpers_.emplace_back([this] { help(); });
  } catch (...) {
    end();
    throw;
  }
}

ThreadTeam::~ThreadTeam() { end(); }

void ThreadTeam::end() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  may_help_.notify_all();
}

void ThreadTeam::for_each_index(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::unique_lock lock(mutex_);
  body_ = &body;
  next_ = 0;
  count_ = count;
  if (count > 1) may_help_.notify_all();
  take_calls(lock);
  returned_.wait(lock, [this] { return running_ == 0; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void ThreadTeam::help() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    take_calls(lock);
    may_help_.wait(lock, [this] { return ends_ || next_ < count_; });
  }
}

// Holds the lock except during a call.
void ThreadTeam::take_calls(std::unique_lock<std::mutex>& lock) {
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

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body) {
  ThreadTeam(static_cast<int>(std::min(thread_count(jobs), std::max<std::size_t>(1, count))))
      .for_each_index(count, body);
}

}  // namespace microswarm
