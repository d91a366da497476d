// SPDX-License-Identifier: Apache-2.0
#include "rig/rig_keys.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace microswarm::cli {
namespace {

bool is_in_front() { return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }

}  // namespace

bool has_keys() { return ::isatty(STDIN_FILENO) == 1 && is_in_front(); }

RigKeys::RigKeys(std::function<void()> stop, std::function<void(const Key&)> other,
                 const Stop& ended)
    : stop_(std::move(stop)), other_(std::move(other)), ended_(ended) {
  if (!has_keys() || ::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  thread_ = std::thread([this] { listen(); });
}

RigKeys::~RigKeys() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

void RigKeys::listen() {
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VMIN] = 1;
  keys.c_cc[VTIME] = 0;
  std::string input;
  while (!over_ && !ended_.requested()) {
    if (!is_in_front()) {  // a read would stop the program
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      continue;
    }
    // Repeated, because a shell resets the terminal when the program is suspended and resumed.
    ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
    if (!read_keys(input)) break;
  }
  if (is_in_front()) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

/// Waits for keys, 20 ms at most. False if the terminal is gone.
bool RigKeys::read_keys(std::string& input) {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  const bool is_ready = ::poll(&in, 1, 20) > 0;
  if (is_ready) {
    std::array<char, 4096> bytes{};
    const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (size <= 0) return false;
    input.append(bytes.data(), static_cast<std::size_t>(size));
  }
  act(take_keys(input, !is_ready));
  return true;
}

void RigKeys::act(const std::vector<Key>& keys) {
  const std::vector<Key> pressed = meant(keys);
  if (std::ranges::any_of(pressed, is_emergency)) return stop_();
  if (other_) std::ranges::for_each(pressed, other_);
}

}  // namespace microswarm::cli
