// SPDX-License-Identifier: Apache-2.0
// Runs the real program at a terminal, as a person who presses keys.
#pragma once

#include <poll.h>
#include <pty.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "program.hpp"

namespace microswarm::test {

/// The program at a pseudo-terminal; killed at the end of its scope if it still runs.
class Terminal {
 public:
  /// `columns` of the terminal. `program` may be another one, such as a shell.
  Terminal(const Arguments& arguments, const Surroundings& at, unsigned short columns = 80)
      : Terminal(MICROSWARM_PROGRAM, arguments, at, columns) {}
  Terminal(const std::string& program, const Arguments& arguments, const Surroundings& at,
           unsigned short columns = 80) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    Environment environment(at);
    child_ = ::forkpty(&line_, nullptr, nullptr, &size);
    if (child_ == 0) {
      if (::chdir(at.folder.c_str()) != 0) ::_exit(126);
      ::execvpe(argv[0], argv.data(), environment.data());
      ::_exit(127);
    }
    listener_ = std::thread([this] { listen(); });
  }
  ~Terminal() {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    hang_up();
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void press(std::string_view keys) const {
    EXPECT_EQ(::write(line_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// The window is closed: nobody reads any more and nothing can be written.
  void hang_up() {
    over_ = true;
    if (listener_.joinable()) listener_.join();
    if (line_ >= 0) ::close(std::exchange(line_, -1));
  }
  void send(int signal) const { ::kill(child_, signal); }
  /// All that it wrote so far, as a terminal gets it.
  std::string said() const {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  /// Waits until it says this after what was heard before.
  bool hears(const std::string& text, int seconds = 30) { return hears_first(text, text, seconds); }
  /// Waits until it says one of two; whether it is the first of them.
  bool hears_first(const std::string& text, const std::string& other, int seconds = 30) {
    std::unique_lock lock(mutex_);
    std::size_t a = std::string::npos, b = std::string::npos;
    const auto is_said = [&] {
      a = said_.find(text, heard_);
      b = said_.find(other, heard_);
      return std::min(a, b) != std::string::npos;
    };
    more_.wait_for(lock, std::chrono::seconds(seconds), [&] { return is_said() || hung_up_; });
    if (!is_said()) return false;
    heard_ = a <= b ? a + text.size() : b + other.size();
    return a <= b;
  }
  /// What it said so far counts as heard.
  void skip() {
    const std::lock_guard lock(mutex_);
    heard_ = said_.size();
  }
  bool running() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  }
  /// Waits for its end and its last words; the exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(child_, 0), &status, 0);
    std::unique_lock lock(mutex_);
    more_.wait_for(lock, std::chrono::seconds(1), [&] { return hung_up_; });
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// Whether what is typed is shown and read by lines, as a shell wants it.
  bool is_as_a_shell_wants_it() const {
    termios settings{};
    return ::tcgetattr(line_, &settings) == 0 && (settings.c_lflag & ECHO) != 0 &&
           (settings.c_lflag & ICANON) != 0;
  }

 private:
  /// Hears it until nobody holds the terminal any more.
  void listen() {
    while (!over_) {
      pollfd ready{line_, POLLIN, 0};
      if (::poll(&ready, 1, 10) <= 0) continue;
      std::array<char, 4096> bytes{};
      const ssize_t size = ::read(line_, bytes.data(), bytes.size());
      {
        const std::lock_guard lock(mutex_);
        if (size > 0) said_.append(bytes.data(), static_cast<std::size_t>(size));
        hung_up_ = size <= 0;
      }
      more_.notify_all();
      if (size <= 0) return;
    }
  }

  int line_ = -1;
  pid_t child_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable more_;
  std::string said_;
  std::size_t heard_ = 0;
  bool hung_up_ = false;
  std::atomic<bool> over_ = false;
  std::thread listener_;
};

}  // namespace microswarm::test
