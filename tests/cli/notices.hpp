// SPDX-License-Identifier: Apache-2.0
// Listens in place of a manager of services, to what a program sends to $NOTIFY_SOCKET.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>

#include "program.hpp"

namespace microswarm::test {

class Notices {
 public:
  /// At a path, or at an abstract address after '@'.
  explicit Notices(std::string address) : address_(std::move(address)) {
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    address_.copy(at.sun_path, sizeof at.sun_path - 1);
    if (address_.starts_with('@')) at.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&at), size), 0) << address_;
  }
  ~Notices() { ::close(socket_); }
  Notices(const Notices&) = delete;
  Notices& operator=(const Notices&) = delete;

  /// Asks a program for signs of life, with a limit of `limit_ms`.
  void ask(Surroundings& at, int limit_ms) const {
    at.environment.emplace_back("NOTIFY_SOCKET", address_);
    at.environment.emplace_back("WATCHDOG_USEC", std::to_string(1000 * limit_ms));
  }
  /// Messages that have come and come within `ms`.
  std::vector<std::string> within(int ms) const {
    std::vector<std::string> all;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    for (pollfd ready{socket_, POLLIN, 0};;) {
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      if (::poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(0, left.count()))) <= 0)
        return all;
      char some[4096];
      const ssize_t n = ::recv(socket_, some, sizeof some, 0);
      all.emplace_back(some, static_cast<std::size_t>(std::max<ssize_t>(0, n)));
    }
  }
  /// Waits for a message with this text.
  bool hears(const std::string& text) const {
    for (int i = 0; i < 6000; ++i)
      for (const std::string& message : within(10))
        if (names(message, text)) return true;
    return false;
  }
  /// Signs of life come, cease while the program is stopped, and come again.
  void expect_signs_of(auto& program) const {
    EXPECT_GE(signs(within(1500)), 5);
    program.send(SIGSTOP);
    within(100);
    EXPECT_EQ(within(600), std::vector<std::string>{});
    program.send(SIGCONT);
    EXPECT_GE(signs(within(1000)), 3);
  }
  static std::ptrdiff_t signs(const std::vector<std::string>& messages) {
    return std::ranges::count(messages, "WATCHDOG=1");
  }

 private:
  std::string address_;
  int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

}  // namespace microswarm::test
