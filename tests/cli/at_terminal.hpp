// SPDX-License-Identifier: Apache-2.0
// Runs the real program at a pseudo-terminal, at which the test types.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/core/execution/clock.hpp"
#include "program.hpp"

namespace microswarm::test {

/// The program at a terminal of its own; killed at the end of its scope.
class AtTerminal {
 public:
  AtTerminal(const Arguments& arguments, const Surroundings& at)
      : AtTerminal(MICROSWARM_PROGRAM, arguments, at) {}
  AtTerminal(const std::string& program, const Arguments& arguments, const Surroundings& at) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = ::forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (child_ != 0) return;
    ::setenv("XDG_STATE_HOME", (at.folder / ".state").c_str(), 1);
    for (const auto& [key, value] : at.environment) ::setenv(key.c_str(), value.c_str(), 1);
    if (::chdir(at.folder.c_str()) != 0) ::_exit(126);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~AtTerminal() {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    ::close(terminal_);
  }
  AtTerminal(const AtTerminal&) = delete;
  AtTerminal& operator=(const AtTerminal&) = delete;

  void send(int signal) const { ::kill(child_, signal); }
  void type(const std::string& keys) const {
    EXPECT_EQ(::write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// Everything it has said.
  const std::string& said() const { return said_; }
  /// Waits until it says this after what was waited for before.
  bool hears(const std::string& text, double seconds = 30) {
    const double until = steady_seconds() + seconds;
    for (;;) {
      if (const std::size_t found = said_.find(text, heard_); found != std::string::npos) {
        heard_ = found + text.size();
        return true;
      }
      if (steady_seconds() > until || !read_more()) return false;
    }
  }
  /// Whether it says the first of these next rather than the second.
  bool hears_first(const std::string& text, const std::string& other, double seconds = 30) {
    const double until = steady_seconds() + seconds;
    for (;;) {
      const std::size_t a = said_.find(text, heard_), b = said_.find(other, heard_);
      if (a != std::string::npos || b != std::string::npos) {
        heard_ = a < b ? a + text.size() : b + other.size();
        return a < b;
      }
      if (steady_seconds() > until || !read_more()) return false;
    }
  }
  /// Waits for its end; the exit code, or minus the signal.
  int wait() {
    while (read_more()) {
    }
    int status = 0;
    ::waitpid(std::exchange(child_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  bool read_more() {
    pollfd in{terminal_, POLLIN, 0};
    if (::poll(&in, 1, 50) == 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t n = ::read(terminal_, bytes.data(), bytes.size());
    if (n > 0) said_.append(bytes.data(), static_cast<std::size_t>(n));
    return n > 0;
  }

  int terminal_ = -1;
  pid_t child_ = -1;
  std::string said_;
  std::size_t heard_ = 0;
};

}  // namespace microswarm::test
