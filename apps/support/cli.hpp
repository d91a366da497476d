// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/progress.hpp"
#include "microswarm/core/stop.hpp"

namespace microswarm::cli {

/// Exit codes of the program. Bad command lines and bad input are 2.
inline constexpr int ok = 0;
inline constexpr int failed = 1;
inline constexpr int bad_input = 2;
inline constexpr int not_reached = 3;
inline constexpr int hardware = 4;

/// What every command is given: the stop that Ctrl-C sets.
struct Context {
  explicit Context(const std::atomic<bool>* flag) : stop(flag), interrupted(flag) {}
  /// The same with a deadline.
  Stop within(double seconds) const {
    return Stop(
        std::chrono::duration_cast<Stop::Clock::duration>(std::chrono::duration<double>(seconds)),
        interrupted);
  }

  Stop stop;
  const std::atomic<bool>* interrupted;
};

/// A command registers its options on the app and sets an action, which main() calls once the whole
/// command line is known to be right; it returns the exit code.
using Action = std::function<int(const Context&)>;

/// Writes results to stdout. Throws InputError "stdout: cannot write: REASON"; when nobody reads
/// stdout any more, the program ends as every program in a pipe does, by SIGPIPE.
void put(std::string_view text);
/// Brings to stdout what put() may still hold back; errors as there.
void flush_output();

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  put(fmt::format(format, std::forward<Values>(values)...));
}

/// Says something on stderr, as far as anybody can read it: a closed terminal is no error.
void say(std::string_view text) noexcept;

template <class... Values>
void note(fmt::format_string<Values...> format, Values&&... values) {
  say(fmt::format(format, std::forward<Values>(values)...));
}

/// Each of them as "note: …" on stderr.
inline void note_each(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) note("note: {}\n", line);
}

/// Progress on stderr, only where that is a terminal: "label [#####.....] 50 % 3 s left note".
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// `share` of the work is done, in [0, 1].
  void update(double share, const std::string& doing = {});

 private:
  std::string label_;
  bool shown_;
  Stop::Clock::time_point began_;
  int last_ = -1;
  std::string note_;
};

/// Progress of library code on such bars, one after the other.
BeginProgress progress_bars();

/// A folder that one command at a time fills, so that two do not mix. The hold goes with the
/// process, however that ends; where a file system has no locks there is none.
class OutFolder {
 public:
  /// Makes the folder, as make_folder, and holds it; nothing when its name is empty. Clears away
  /// the temporary files of programs that were killed. Throws InputError "FOLDER: another command
  /// is writing to it".
  explicit OutFolder(const std::string& folder);
  /// Takes away what it made and nothing came into.
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  int folder_ = -1;
  std::vector<std::filesystem::path> made_;  // the innermost first
};

/// Throws InputError when the file to be written is the one that is read.
void keep_input(const std::string& out, const std::string& in);

/// Folder of the scenarios that come with the program: of the source tree it was built in, or of
/// the installation. Throws InputError when there is none.
std::filesystem::path scenario_folder();

}  // namespace microswarm::cli
