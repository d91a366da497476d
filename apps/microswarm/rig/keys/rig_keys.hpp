// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "rig/keys/key_input.hpp"
#include "rig/keys/key_terminal.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {

/// Calls `stop` when an emergency key is pressed, and `other` for other keys, if the program has a
/// terminal. A single Esc is recognised after 20 ms. The terminal's settings are restored when the
/// program is asked to end.
class RigKeys {
 public:
  /// Both functions are called in the reader's own thread.
  RigKeys(std::function<void()> stop, std::function<void(const Key&)> other, const Stop& ended);
  ~RigKeys();
  RigKeys(const RigKeys&) = delete;
  RigKeys& operator=(const RigKeys&) = delete;
  bool are_there() const { return thread_.joinable(); }

 private:
  void listen();
  bool read_keys(std::string& input);
  void act(const std::vector<Key>& keys);

  std::function<void()> stop_;
  std::function<void(const Key&)> other_;
  Stop ended_;
  KeyTerminal terminal_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace microswarm::cli
