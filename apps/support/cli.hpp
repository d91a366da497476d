// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/execution/progress.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "support/status_line.hpp"

namespace microswarm::cli {

/// Exit codes of the program. Bad command lines and bad input are 2.
inline constexpr int ok = 0;
inline constexpr int failed = 1;
inline constexpr int bad_input = 2;
inline constexpr int not_reached = 3;
inline constexpr int hardware = 4;
/// Like `ok`, but says that the work is complete even if Ctrl-C was pressed; the program ends with
/// 0.
inline constexpr int complete = -1;

/// Context of every command: the stop set by Ctrl-C.
struct Context {
  explicit Context(const std::atomic<bool>* flag) : stop(flag), interrupted(flag) {}
  /// The stop with an additional deadline.
  Stop within(double seconds) const {
    return Stop(
        std::chrono::duration_cast<Stop::Clock::duration>(std::chrono::duration<double>(seconds)),
        interrupted);
  }

  Stop stop;
  const std::atomic<bool>* interrupted;
};

/// Marks that input is being read and no work has begun: while an instance lives, the first Ctrl-C
/// ends the program at once, with exit code 3.
class Reading {
 public:
  Reading();
  ~Reading();
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
};

/// Calls `read`, which reads input, and returns its result.
template <class Read>
auto reading(Read&& read) {
  const Reading now;
  return read();
}

/// A command registers its options on the app and sets an action. main() calls it after the command
/// line is validated; it returns the exit code.
using Action = std::function<int(const Context&)>;

/// Writes results to stdout, as `printable`. Throws InputError "stdout: cannot write: REASON". If
/// the reader of a pipe has gone, the program ends by SIGPIPE.
void put(std::string_view text);
/// Flushes output buffered by put(); errors as there.
void flush_output();

/// Formats and writes to stdout by put().
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  put(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes to stderr, as `printable`, above a status line; errors such as a closed terminal are
/// ignored.
void say(std::string_view text) noexcept;

/// Formats and writes to stderr by say().
template <class... Values>
void note(fmt::format_string<Values...> format, Values&&... values) {
  say(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes each line to stderr as "note: …".
inline void note_each(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) note("note: {}\n", line);
}

/// Shows progress of library code on progress bars.
BeginProgress progress_bars();

/// An output folder, locked for one command at a time. The lock ends with the process; on file
/// systems without locks there is none.
class OutFolder {
 public:
  /// Creates the folder, as make_folder, and locks it; does nothing for an empty name. Removes
  /// temporary files of killed programs. Throws InputError "FOLDER: another command is writing to
  /// it".
  explicit OutFolder(const std::string& folder);
  /// Removes the folders it created that are still empty.
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  Descriptor folder_;
  std::vector<std::filesystem::path> made_;  // innermost first
};

/// Throws InputError if the file to be written is the input.
void keep_input(const std::string& out, const std::string& in);

/// Folder of the shipped scenarios, in the source tree of the build or in the installation. Throws
/// InputError if there is none.
std::filesystem::path scenario_folder();
/// The same, but sets `error` if there is none.
std::filesystem::path scenario_folder(std::error_code& error);

}  // namespace microswarm::cli
