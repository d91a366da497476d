// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "microswarm/actuation/drivers/serial_coil_driver.hpp"

namespace microswarm::test {

using Outputs = std::array<int, 6>;

inline constexpr double full_scale = 20;  // [A]
inline constexpr double zero_within_ms = 150;
inline constexpr auto patience = std::chrono::seconds(20);
inline constexpr Outputs off{};
inline constexpr std::array<double, 6> some{2, -4, 6, -8, 10, -20};  // [A]
inline constexpr Outputs some_outputs{100, -200, 300, -400, 500, -1000};

/// The simulator as a child, and what it prints.
class Simulator {
 public:
  /// `heard` is called with every change of the outputs, in a thread of the simulator's own.
  explicit Simulator(const char* bootloader = nullptr, const char* firmware = FIRMWARE,
                     std::function<void(const Outputs&)> heard = {})
      : heard_(std::move(heard)) {
    std::array<int, 2> to{}, from{};
    if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0) std::abort();
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], STDIN_FILENO);
      dup2(from[1], STDOUT_FILENO);
      execl(MEGA_SIMULATOR, MEGA_SIMULATOR, firmware, bootloader, nullptr);
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    orders_ = to[1];
    listener_ = std::thread([this, from] { listen(fdopen(from[0], "r")); });
  }
  ~Simulator() {
    close(orders_);
    waitpid(child_, nullptr, 0);
    listener_.join();
  }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  std::string port() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, patience, [&] { return !port_.empty(); });
    return port_;
  }
  /// When the device obeyed it [ms].
  double order(const std::string& line) {
    std::unique_lock lock(mutex_);
    const auto before = marks_;
    const std::string text = line + "\n";
    EXPECT_EQ(write(orders_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    EXPECT_TRUE(news_.wait_for(lock, patience, [&] { return marks_ != before; }));
    return marked_;
  }
  /// Whether the amplifiers are enabled.
  bool enabled() {
    std::scoped_lock lock(mutex_);
    return enabled_;
  }
  Outputs outputs() {
    std::scoped_lock lock(mutex_);
    return outputs_;
  }
  /// When the outputs became these [ms], waiting for it; nothing if they did not.
  std::optional<double> when(const Outputs& wanted) {
    std::unique_lock lock(mutex_);
    if (outputs_ == wanted) return changed_;
    wanted_ = wanted;
    matched_.reset();
    news_.wait_for(lock, patience, [&] { return matched_.has_value(); });
    return matched_;
  }

 private:
  void listen(std::FILE* file) {
    std::array<char, 256> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), file)) {
      std::istringstream words(line.data());
      std::string what;
      words >> what;
      std::scoped_lock lock(mutex_);
      if (what == "port") words >> port_;
      if (what == "mark") {
        words >> marked_;
        ++marks_;
      }
      if (what == "enable") words >> enabled_;
      if (what == "out") {
        words >> changed_;
        for (int& o : outputs_) words >> o;
        if (outputs_ == wanted_ && !matched_) matched_ = changed_;  // it may not stay so
        if (heard_) heard_(outputs_);
      }
      news_.notify_all();
    }
    std::fclose(file);
  }

  std::function<void(const Outputs&)> heard_;
  pid_t child_ = -1;
  int orders_ = -1;
  std::thread listener_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::string port_;
  double changed_ = 0, marked_ = 0;
  int marks_ = 0;
  bool enabled_ = false;
  Outputs outputs_{}, wanted_{};
  std::optional<double> matched_;  // when they became those wanted
};

inline actuation::SerialCoilParams params(const std::string& port) {
  actuation::SerialCoilParams p;
  p.port = port;
  p.full_scale = full_scale;
  p.reply_timeout = 0.1;
  p.attempts = 20;  // a busy computer simulates late
  return p;
}

}  // namespace microswarm::test
