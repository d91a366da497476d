// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"

namespace microswarm::rig {

/// Log of the coil outputs, commands.csv. During the run the file is named commands.csv.part.
class CommandLog {
 public:
  /// Logs into `folder`; an empty path disables the log. Rows of a dry run are marked.
  CommandLog(const std::filesystem::path& folder, const actuation::CoilSystem& system, bool dry);
  /// Without finish() the file keeps its temporary name; it is removed if it has no row.
  ~CommandLog();
  CommandLog(const CommandLog&) = delete;
  CommandLog& operator=(const CommandLog&) = delete;

  /// Adds a row. Times count from `start` [s], by steady_seconds(), as those of the record. Throws
  /// InputError if the file cannot be written.
  void add(const CoilMoment& moment, double start);

  /// Adds the zero at the end and renames the log to its final name. Returns the reason of a
  /// failure, or an empty string.
  std::string finish(const actuation::StopReport& zero) noexcept;

 private:
  void write(const std::string& text);

  std::filesystem::path file_;
  std::filesystem::path part_;
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> out_;
  std::size_t coils_;
  bool dry_;
  std::optional<double> start_;  // set with the first row
};

}  // namespace microswarm::rig
