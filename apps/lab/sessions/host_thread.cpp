// SPDX-License-Identifier: Apache-2.0
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "lab/sessions/host.hpp"

namespace microswarm::lab {

/// Work for the session's thread.
class Host::Queue {
 public:
  std::mutex mutex;
  std::condition_variable wake;
  std::vector<std::function<void()>> work;  ///< guarded
  std::thread thread;
};

Host::Host(Opening opening, Callbacks callbacks)
    : opening_(std::move(opening)),
      callbacks_(std::move(callbacks)),
      publisher_(callbacks_.send),
      queue_(std::make_unique<Queue>()) {}

Host::~Host() = default;

void Host::begin() {
  queue_->thread = std::thread([this] {
    start();
    while (!ends_) serve_once();
    close();
    has_ended_ = true;
  });
}

void Host::finish() {
  end();
  if (queue_->thread.joinable()) queue_->thread.join();
}

void Host::end() {
  ends_ = true;
  const std::lock_guard lock(queue_->mutex);
  queue_->wake.notify_all();
}

void Host::later(std::function<void()> work) {
  const std::lock_guard lock(queue_->mutex);
  queue_->work.push_back(std::move(work));
  queue_->wake.notify_all();
}

void Host::work_until(std::optional<Clock::time_point> latest) {
  std::vector<std::function<void()>> work;
  {
    std::unique_lock lock(queue_->mutex);
    const auto wakes = [this] { return ends_ || !queue_->work.empty(); };
    if (latest)
      queue_->wake.wait_until(lock, *latest, wakes);
    else
      queue_->wake.wait(lock, wakes);
    work.swap(queue_->work);
  }
  for (const auto& one : work) one();
}

}  // namespace microswarm::lab
