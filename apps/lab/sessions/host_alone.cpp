// SPDX-License-Identifier: Apache-2.0
// Replaces host_thread.cpp in a build without threads: who owns the session calls turn().
#include <utility>
#include <vector>

#include "lab/sessions/host.hpp"

namespace microswarm::lab {

/// Work for the next turn.
class Host::Queue {
 public:
  std::vector<std::function<void()>> work;
  std::optional<Clock::time_point> next;  ///< time until which work_until() was to wait
};

Host::Host(Opening opening, Callbacks callbacks)
    : opening_(std::move(opening)),
      callbacks_(std::move(callbacks)),
      publisher_(callbacks_.send),
      queue_(std::make_unique<Queue>()) {}

Host::~Host() = default;

void Host::begin() { start(); }

void Host::finish() { end(); }

void Host::end() { ends_ = true; }

void Host::later(std::function<void()> work) { queue_->work.push_back(std::move(work)); }

/// Waits for nothing: what is not due yet is not done in this turn.
void Host::work_until(std::optional<Clock::time_point> latest) {
  queue_->next = latest;
  for (const auto& one : std::exchange(queue_->work, {})) one();
}

std::optional<Stop::Clock::time_point> Host::turn() {
  if (ends_) return std::nullopt;
  const bool is_asked = !queue_->work.empty();
  serve_once();
  // What was done changes what comes next, which the next turn finds.
  const bool has_acted = is_asked || (queue_->next && *queue_->next <= Clock::now());
  return has_acted ? Clock::time_point{} : queue_->next;
}

}  // namespace microswarm::lab
