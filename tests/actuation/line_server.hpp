// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/actuation/drivers/line_protocol.hpp"
#include "microswarm/core/text/lines.hpp"

namespace microswarm::test {

/// A server at a Unix socket or a TCP port. `answer` gets the words of a message.
class LineServer {
 public:
  using Words = std::vector<std::string>;
  explicit LineServer(std::function<std::string(const Words&)> answer = {}, bool tcp = false)
      : answer_(std::move(answer)) {
    path_ = testing::TempDir() + "line_" + std::to_string(::getpid()) + ".sock";
    ::unlink(path_.c_str());
    listening_ = ::socket(tcp ? AF_INET : AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un path{.sun_family = AF_UNIX, .sun_path = {}};
    path_.copy(path.sun_path, sizeof path.sun_path - 1);
    sockaddr_in port{};
    port.sin_family = AF_INET;
    port.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* const at = tcp ? reinterpret_cast<sockaddr*>(&port) : reinterpret_cast<sockaddr*>(&path);
    socklen_t size = tcp ? sizeof port : sizeof path;
    EXPECT_EQ(::bind(listening_, at, size), 0);
    EXPECT_EQ(::listen(listening_, 1), 0);
    ::getsockname(listening_, at, &size);
    port_ = ntohs(port.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~LineServer() {
    over_ = true;
    thread_.join();
    ::close(listening_);
    ::unlink(path_.c_str());
  }
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  const std::string& path() const { return path_; }
  int port() const { return port_; }
  int count(const std::string& word) {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(
        std::ranges::count_if(heard_, [&](const Words& words) { return words[0] == word; }));
  }
  Words last() {
    const std::lock_guard lock(mutex_);
    return heard_.empty() ? Words{} : heard_.back();
  }
  /// What a good driver answers.
  static std::string good(const Words& words) {
    std::string reply = "ok " + words[1];
    if (words[0] == "set")
      for (std::size_t k = 2; k < words.size(); ++k) reply += " " + words[k];
    else
      reply += " 0 0 0";
    return reply + "\n";
  }

 private:
  void run() {
    pollfd waiting{listening_, POLLIN, 0};
    while (!over_ && ::poll(&waiting, 1, 5) <= 0) {
    }
    if (over_) return;
    const int line = ::accept(listening_, nullptr, nullptr);
    actuation::LineReader reader;
    while (!over_) {
      pollfd ready{line, POLLIN, 0};
      if (::poll(&ready, 1, 5) <= 0) continue;
      std::array<std::uint8_t, 512> bytes{};
      const ssize_t n = ::read(line, bytes.data(), bytes.size());
      if (n <= 0) break;
      for (ssize_t k = 0; k < n; ++k)
        if (const auto text = reader.take(bytes[static_cast<std::size_t>(k)])) {
          Words heard;
          for (const std::string_view word : words(*text)) heard.emplace_back(word);
          {
            const std::lock_guard lock(mutex_);
            heard_.push_back(heard);
          }
          const std::string reply = answer_ ? answer_(heard) : good(heard);
          if (reply == "close" || reply == "reset") {
            const linger at_once{.l_onoff = reply == "reset", .l_linger = 0};
            ::setsockopt(line, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
            ::close(line);
            return;
          }
          EXPECT_EQ(::send(line, reply.data(), reply.size(), MSG_NOSIGNAL),
                    static_cast<ssize_t>(reply.size()));
        }
    }
    ::close(line);
  }

  std::function<std::string(const Words&)> answer_;
  std::string path_;
  int listening_ = -1;
  int port_ = 0;
  std::atomic<bool> over_ = false;
  std::mutex mutex_;
  std::vector<Words> heard_;
  std::thread thread_;
};

}  // namespace microswarm::test
