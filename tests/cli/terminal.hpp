// SPDX-License-Identifier: Apache-2.0
// Runs the real program at a terminal, as a person who presses keys.
#pragma once

#include <poll.h>
#include <pty.h>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include "program.hpp"

namespace microswarm::test {

/// The program at a pseudo-terminal; killed at the end of its scope if it still runs.
class Terminal {
 public:
  /// `columns` of the terminal. `words` is the command line: the program, or a shell.
  Terminal(const Arguments& arguments, const Surroundings& at, unsigned short columns = 80)
      : Terminal(MICROSWARM_PROGRAM, arguments, at, columns) {}
  Terminal(const std::string& program, const Arguments& arguments, const Surroundings& at,
           unsigned short columns) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    child_ = ::forkpty(&line_, nullptr, nullptr, &size);
    if (child_ == 0) {
      ::setenv("XDG_STATE_HOME", (at.folder / ".state").c_str(), 1);
      for (const auto& [key, value] : at.environment) ::setenv(key.c_str(), value.c_str(), 1);
      if (::chdir(at.folder.c_str()) != 0) ::_exit(126);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    listener_ = std::thread([this] { listen(); });
  }
  ~Terminal() {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      wait();
    }
    over_ = true;
    listener_.join();
    ::close(line_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void press(std::string_view keys) const {
    EXPECT_EQ(::write(line_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  void send(int signal) const { ::kill(child_, signal); }
  /// All that it wrote so far, as a terminal gets it.
  std::string said() const {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  /// Waits until it has written `text` after the first `from` bytes, 20 s at most.
  bool says(const std::string& text, std::size_t from = 0) const {
    for (int i = 0; i < 2000; ++i) {
      if (said().find(text, from) != std::string::npos) return true;
      sleep_ms(10);
    }
    ADD_FAILURE() << "did not say '" << text << "' but\n" << said();
    return false;
  }
  bool running() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  }
  /// Exit code; -1 when a signal ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(child_, 0), &status, 0);
    sleep_ms(50);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Whether what is typed is shown and read by lines, as a shell wants it.
  bool is_as_a_shell_wants_it() const {
    termios settings{};
    return ::tcgetattr(line_, &settings) == 0 && (settings.c_lflag & ECHO) != 0 &&
           (settings.c_lflag & ICANON) != 0;
  }

 private:
  void listen() {
    while (!over_) {
      pollfd ready{line_, POLLIN, 0};
      if (::poll(&ready, 1, 10) <= 0) continue;
      std::array<char, 4096> bytes{};
      const ssize_t size = ::read(line_, bytes.data(), bytes.size());
      if (size <= 0) {
        sleep_ms(10);
        continue;
      }
      const std::lock_guard lock(mutex_);
      said_.append(bytes.data(), static_cast<std::size_t>(size));
    }
  }

  int line_ = -1;
  pid_t child_ = 0;
  mutable std::mutex mutex_;
  std::string said_;
  std::atomic<bool> over_ = false;
  std::thread listener_;
};

}  // namespace microswarm::test
