// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"
#include "microswarm/rig/runtime/log_parts.hpp"

namespace microswarm::rig {

/// Log of the coil outputs, commands.csv. During the run the file is named commands.csv.part; full
/// parts of a long one are commands-0001.csv and so on, see LogParts.
class CommandLog {
 public:
  /// Logs into `folder`; an empty path disables the log. Rows of a dry run are marked.
  CommandLog(const std::filesystem::path& folder, const actuation::CoilSystem& system, bool dry,
             const LogLimits& limits = {});
  ~CommandLog() = default;
  CommandLog(const CommandLog&) = delete;
  CommandLog& operator=(const CommandLog&) = delete;

  /// Adds a row. Times count from `start` [s], by steady_seconds(), as those of the record. Throws
  /// InputError if earlier rows could not be written.
  void add(const CoilMoment& moment, double start);

  /// Adds the zero at the end and renames the log to its final name. Returns the reason of a
  /// failure, or an empty string.
  std::string finish(const actuation::StopReport& zero) noexcept;

 private:
  std::optional<LogParts> parts_;
  std::size_t coils_;
  bool dry_;
  std::optional<double> start_;  // set with the first row
};

}  // namespace microswarm::rig
