// SPDX-License-Identifier: Apache-2.0
#include "rig/keys/rig_keys.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "microswarm/core/execution/priority.hpp"

namespace microswarm::cli {

RigKeys::RigKeys(std::function<void()> stop, std::function<void(const Key&)> other,
                 const Stop& ended)
    : stop_(std::move(stop)), other_(std::move(other)), ended_(ended) {
  if (has_keys() && terminal_.is_there()) thread_ = std::thread([this] { listen(); });
}

RigKeys::~RigKeys() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

void RigKeys::listen() {
  // One above the ticks, whose priority it has inherited.
  const int inherited = realtime_priority();
  const RealtimePriority priority(inherited > 0 ? inherited + 1 : 0);
  std::string input;
  while (!over_ && !ended_.requested()) {
    if (!terminal_.prepare())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    else if (!read_keys(input))
      break;
  }
  terminal_.restore();
}

/// Waits up to 20 ms for keys. False if the terminal is gone.
bool RigKeys::read_keys(std::string& input) {
  const std::optional<std::string> got = input_within(20);
  if (!got) return false;
  input += *got;
  act(take_keys(input, got->empty()));
  return true;
}

void RigKeys::act(const std::vector<Key>& keys) {
  const std::vector<Key> pressed = meant(keys);
  if (std::ranges::any_of(pressed, is_emergency)) return stop_();
  if (other_) std::ranges::for_each(pressed, other_);
}

}  // namespace microswarm::cli
