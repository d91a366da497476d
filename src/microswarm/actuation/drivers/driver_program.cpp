// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "microswarm/actuation/drivers/line_connection.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/spawning.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr double patience = 0.5;        // [s] before each stronger request to end
constexpr double short_patience = 0.1;  // [s] with a program that does not answer
constexpr double a_moment = 0.05;       // [s]

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw HardwareError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    out = Descriptor(ends[0]);
    in = Descriptor(ends[1]);
  }
  Descriptor out, in;
};

Descriptor not_blocking(Descriptor end) {
  ::fcntl(end.get(), F_SETFL, O_NONBLOCK);
  return end;
}

class DriverProgram final : public LineConnection {
 public:
  DriverProgram(const std::vector<std::string>& command, const std::filesystem::path& folder,
                const std::vector<int>& locks)
      : name_(to_device(command, folder).name) {
    Pipe in, out, err;
    Spawning spawning;
    spawning.files(in.out.get(), out.in.get(), err.in.get(), locks);
    if (!folder.empty()) spawning.folder(folder);
    const auto process = spawning.start(command);
    if (!process)
      throw HardwareError(fmt::format("{}: cannot be started: {}", name_, std::strerror(errno)));
    process_ = *process;
    in_ = not_blocking(std::move(in.in));
    out_ = not_blocking(std::move(out.out));
    err_ = not_blocking(std::move(err.out));
    stream_.emplace(out_.get(), in_.get());
  }

  DriverProgram(const DriverProgram&) = delete;
  DriverProgram& operator=(const DriverProgram&) = delete;
  ~DriverProgram() override {
    in_.close();
    // Not reaped before that, so that no other process gets its id.
    for (const int signal : {0, SIGTERM, SIGKILL}) {
      if (killed_ && signal == 0) continue;
      if (signal != 0) ::kill(-process_, signal);
      if (is_over_within(killed_ ? short_patience : patience)) break;
    }
    for (int status = 0; ::waitpid(process_, &status, WNOHANG) < 0 && errno == EINTR;) {
    }
  }

  const std::string& name() const override { return name_; }
  ByteStream& stream() override { return *stream_; }
  std::string last_words() override {
    hear();
    return last_line_;
  }

  void give_up() noexcept override { killed_ = true; }

  std::string ended() override {
    siginfo_t info{};
    const bool silent = stream_->ended();
    if (silent) is_over_within(a_moment);  // it is usually about to end by itself
    hear();
    if (!exited(info)) return silent ? "has closed its output" : "";
    if (info.si_code == CLD_EXITED)
      return fmt::format("has ended with exit code {}", info.si_status);
    const char* const name = ::sigdescr_np(info.si_status);
    return fmt::format("was ended by signal {}{}", info.si_status,
                       name ? fmt::format(" ({})", name) : "");
  }

 private:
  bool exited(siginfo_t& info) const {
    return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid != 0;
  }

  /// Waits up to `seconds` until the program and all holders of its output have ended.
  bool is_over_within(double seconds) {
    const auto began = Stop::Clock::now();
    for (;;) {
      hear();
      while (stream_->get(0) && seconds_since(began) <= seconds) {  // it may send without end
      }
      siginfo_t info{};
      if (stream_->ended() && exited(info)) return true;
      if (seconds_since(began) > seconds) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  /// Reads its stderr, so that it does not block on writing.
  void hear() {
    constexpr std::size_t longest = 400;
    constexpr int max_reads = 64;
    std::array<char, 4096> bytes;
    for (int k = 0; k < max_reads; ++k) {
      const ssize_t n = ::read(err_.get(), bytes.data(), bytes.size());
      if (n == 0) end_line();
      if (n <= 0) return;
      for (const char c : std::string_view(bytes.data(), static_cast<std::size_t>(n))) {
        if (c == '\n')
          end_line();
        else if (line_.size() < longest)
          line_ += c;
      }
    }
  }

  void end_line() {
    if (!trimmed(line_).empty()) last_line_ = one_line(trimmed(line_));
    line_.clear();
  }

  std::string name_;
  pid_t process_ = 0;
  bool killed_ = false;
  Descriptor in_, out_, err_;
  std::optional<ByteStream> stream_;
  std::string line_, last_line_;  // of stderr: the incomplete line, and the last complete one
};

}  // namespace

LineDevice to_device(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  LineDevice device{.name = one_line(fmt::format("{}", fmt::join(command, " ")), 80)};
  std::error_code none;
  for (const std::string& word : command) {
    const std::filesystem::path file = folder / word;
    const bool is_file = std::filesystem::is_regular_file(file, none);
    device.key += (is_file ? std::filesystem::canonical(file, none).string() : word) + '\n';
  }
  return device;
}

std::unique_ptr<LineConnection> start_program(const std::vector<std::string>& command,
                                              const std::filesystem::path& folder,
                                              const std::vector<int>& locks) {
  return std::make_unique<DriverProgram>(command, folder, locks);
}

}  // namespace microswarm::actuation
