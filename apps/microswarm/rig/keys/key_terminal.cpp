// SPDX-License-Identifier: Apache-2.0
#include "rig/keys/key_terminal.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace microswarm::cli {

bool has_keys() { return ::isatty(STDIN_FILENO) == 1 && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }

std::optional<std::string> input_within(int ms) {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  if (::poll(&in, 1, ms) <= 0) return "";
  std::array<char, 4096> bytes{};
  const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return "";
  if (size <= 0) return std::nullopt;
  return std::string(bytes.data(), static_cast<std::size_t>(size));
}

KeyTerminal::KeyTerminal()
    : is_there_(::isatty(STDIN_FILENO) == 1 && ::tcgetattr(STDIN_FILENO, &before_) == 0) {}

bool KeyTerminal::prepare() const {
  if (!is_there_ || !has_keys()) return false;
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VMIN] = 1;
  keys.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
  return true;
}

void KeyTerminal::restore() const {
  if (is_there_ && has_keys()) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

}  // namespace microswarm::cli
