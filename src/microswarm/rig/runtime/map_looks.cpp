// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/map_looks.hpp"

#include <exception>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::rig {

MapLooks::MapLooks(std::shared_ptr<const PictureRegistration> registration, double max_shift)
    : registration_(std::move(registration)), max_shift_(max_shift), thread_([this] { work(); }) {}

MapLooks::~MapLooks() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool MapLooks::offer(const formats::Image& picture, double t) {
  {
    const std::lock_guard lock(mutex_);
    if (waits_) return false;
    waits_ = true;
    picture_ = picture;
    t_ = t;
  }
  changed_.notify_all();
  return true;
}

std::optional<std::pair<MapLook, double>> MapLooks::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(look_, std::nullopt);
}

Durations MapLooks::times() const {
  const std::lock_guard lock(mutex_);
  return times_;
}

void MapLooks::work() {
  lower_priority();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || waits_; });
    if (ends_) return;
    lock.unlock();
    const double began = steady_seconds();
    MapLook look;
    try {
      look = look_at_map(*registration_, picture_, max_shift_);
    } catch (const std::exception& error) {  // the coils are driven: the run must not die of it
      look.fit.unsure = one_line(error.what());
    }
    const double took = steady_seconds() - began;
    lock.lock();
    look_ = {std::move(look), t_};
    times_.add(took);
    waits_ = false;
  }
}

}  // namespace microswarm::rig
