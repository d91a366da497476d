// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/execution/inheriting_mutex.hpp"

namespace microswarm::rig {

/// Limits of a LogParts.
struct LogLimits {
  std::uint64_t part_bytes = 100'000'000;  ///< largest part
  double sync_period = 1;  ///< longest time for which a line may wait for the disk [s]
};

/// The complete parts of a log in their order: commands-0001.csv, …, and commands.csv, the last
/// one. The part that is written is not among them.
std::vector<std::filesystem::path> log_parts(const std::filesystem::path& log);

/// Text of a log, its parts as one with the header once. Throws InputError if a part is missing,
/// has another header or is larger than 1 GiB.
std::string read_log(const std::filesystem::path& log);

/// A log of lines in parts of bounded size, each with the header. A thread writes the lines and
/// syncs them with the disk, so that a power cut loses at most those of a `sync_period`, and that a
/// slow disk delays nobody. The part that is written has the extension .part.
class LogParts {
 public:
  /// Creates the first part. A link in its place is not followed. Throws InputError.
  LogParts(std::filesystem::path log, std::string header, const LogLimits& limits = {});
  /// Without finish() the last part keeps its temporary name; it is removed if there is no line.
  ~LogParts();
  LogParts(const LogParts&) = delete;
  LogParts& operator=(const LogParts&) = delete;

  /// Adds a line. The first one removes the parts of an earlier log of this name. Throws InputError
  /// if earlier lines could not be written.
  void add(std::string_view line);
  /// Writes all lines and gives the last part its name. Returns the reason of a failure, or an
  /// empty string.
  std::string finish() noexcept;
  bool is_empty() const { return is_empty_; }

 private:
  void run();
  void take(std::string_view lines);
  void write(std::string_view bytes);
  void sync() const;
  void begin_part();
  void end_part(const std::filesystem::path& name);
  void join();

  const std::filesystem::path log_;
  const std::filesystem::path part_;
  const std::string header_;
  const LogLimits limits_;
  bool is_empty_ = true;

  // Of the writing thread.
  Descriptor file_;
  std::uint64_t size_ = 0;  // of the part
  int parts_ = 0;           // complete ones

  InheritingMutex mutex_;
  std::condition_variable_any wake_;
  std::string waiting_;  // lines; guarded, as the next two
  std::string trouble_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace microswarm::rig
