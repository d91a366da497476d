// SPDX-License-Identifier: Apache-2.0
// Runs the real program as a person would, in a folder of the test's own.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "microswarm/core/text/file.hpp"
#include "tests/messages.hpp"

namespace microswarm::test {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// How a program ended and what it said.
struct Outcome {
  int code = -1;   ///< exit code; -1 when a signal ended it
  int signal = 0;  ///< that ended it
  std::string out;
  std::string err;
};

/// Where the program runs, and what is different from everyday.
struct Surroundings {
  fs::path folder;
  std::string program = MICROSWARM_PROGRAM;
  std::uint64_t largest_file = 0;  ///< [bytes] beyond which writing fails; 0: no limit
  std::string out;                 ///< stdout goes to this file
  std::string in;                  ///< stdin comes from this file, when not empty
  std::string path;                ///< PATH, when not empty
  std::vector<std::pair<std::string, std::string>> environment;  ///< more of it
};

/// Environment of a program: this process's, with what its surroundings change. It is made before a
/// fork: in the child of a process with threads nothing may be allocated before exec, or it hangs
/// now and then.
class Environment {
 public:
  explicit Environment(const Surroundings& at) {
    auto changed = at.environment;
    changed.emplace_back("XDG_STATE_HOME", (at.folder / ".state").string());
    if (!at.path.empty()) changed.emplace_back("PATH", at.path);
    for (char** one = ::environ; *one; ++one) {
      const std::string_view text = *one;
      const std::string_view key = text.substr(0, text.find('='));
      if (std::ranges::none_of(changed, [&](const auto& change) { return change.first == key; }))
        all_.emplace_back(text);
    }
    for (const auto& [key, value] : changed) all_.push_back(key + "=" + value);
    for (std::string& one : all_) pointers_.push_back(one.data());
    pointers_.push_back(nullptr);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  char** data() { return pointers_.data(); }

 private:
  std::vector<std::string> all_;
  std::vector<char*> pointers_;
};

inline void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

/// The program at work; killed at the end of its scope if it still is.
class Program {
 public:
  Program(const Arguments& arguments, const Surroundings& at) : out_(file()), err_(file()) {
    const int out = at.out.empty() ? fileno(out_) : ::open(at.out.c_str(), O_WRONLY);
    std::vector<std::string> words{at.program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    Environment environment(at);
    const int err = fileno(err_);
    child_ = ::fork();
    if (child_ != 0) return;
    if (at.largest_file > 0) {
      const rlimit limit{at.largest_file, at.largest_file};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      std::signal(SIGXFSZ, SIG_IGN);
    }
    if (::chdir(at.folder.c_str()) != 0 || ::dup2(out, STDOUT_FILENO) < 0 ||
        ::dup2(err, STDERR_FILENO) < 0 ||
        (!at.in.empty() && ::dup2(::open(at.in.c_str(), O_RDONLY), STDIN_FILENO) < 0))
      ::_exit(126);
    ::execve(argv[0], argv.data(), environment.data());
    ::_exit(127);
  }
  ~Program() {
    if (child_ > 0) {
      send(SIGKILL);
      wait();
    }
    std::fclose(out_);
    std::fclose(err_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Lets it come to itself, until it has taken SIGINT in hand, and then work for `ms` more.
  void let_work(int ms) const {
    const std::string status = "/proc/" + std::to_string(child_) + "/status";
    for (int i = 0; i < 6000 && !catches_interrupt(read_file(status)); ++i) sleep_ms(10);
    sleep_ms(ms);
  }
  void send(int signal) const { ::kill(child_, signal); }
  bool running() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  }
  Outcome wait() {
    int status = 0;
    ::waitpid(std::exchange(child_, 0), &status, 0);
    Outcome outcome{.out = said(out_), .err = said(err_)};
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    return outcome;
  }

 private:
  static bool catches_interrupt(const std::string& status) {
    const std::size_t at = status.find("SigCgt:");
    return at != std::string::npos &&
           (std::strtoull(status.c_str() + at + 7, nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  static std::FILE* file() {
    std::FILE* made = std::tmpfile();
    if (!made) throw std::runtime_error("no temporary file");
    return made;
  }
  static std::string said(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
    return text;
  }

  std::FILE* out_;
  std::FILE* err_;
  pid_t child_ = 0;
};

/// A test with an empty folder, in which the program runs.
class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = "microswarm_cli_" + std::string(info->name());
    std::ranges::replace(name, '/', '_');  // of a parameter
    at.folder = fs::path(testing::TempDir()) / (name + "_" + std::to_string(::getpid()));
    fs::remove_all(at.folder);
    fs::create_directories(at.folder);
  }
  ~CommandLine() override { fs::remove_all(at.folder); }

  void write(const std::string& name, std::string_view bytes) const {
    write_file_atomically(at.folder / name, bytes);
  }
  std::string read(const std::string& name) const { return read_file(at.folder / name); }
  bool exists(const std::string& name) const { return fs::exists(at.folder / name); }
  /// Every file below the folder.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(at.folder))
      if (!entry.is_directory()) names.insert(entry.path().lexically_relative(at.folder));
    return names;
  }

  Outcome run(const Arguments& arguments) const { return Program(arguments, at).wait(); }
  /// What it says on stdout when all is well.
  std::string good(const Arguments& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }
  /// Bad input: one line on stderr, nothing on stdout, exit code 2, and no file more or less.
  void refused(const Arguments& arguments, const Complaint& complaint) const {
    const std::set<std::string> before = files();
    const Outcome outcome = run(arguments);
    constexpr std::string_view name = "microswarm: ";
    EXPECT_TRUE(outcome.err.starts_with(name) && outcome.err.ends_with('\n')) << outcome.err;
    EXPECT_TRUE(is(outcome.err.substr(std::min(name.size(), outcome.err.size())), complaint));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(files(), before);
  }
  /// The same for a scenario.
  void run_refused(const std::string& scenario, const Complaint& complaint) const {
    write("flight.yaml", scenario);
    refused({"run", "flight.yaml"}, complaint);
  }

  Surroundings at;
};

}  // namespace microswarm::test
