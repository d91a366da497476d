// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"

namespace microswarm {

/// commands.csv: what went to the coils. While the run lasts it is commands.csv.part, written as it
/// goes.
class CommandLog {
 public:
  /// In this folder; nothing is kept without one. A dry run's rows say so.
  CommandLog(const std::filesystem::path& folder, const CoilSystem& system, bool dry);

  /// Throws InputError when it cannot be written.
  void add(const CoilMoment& moment);

  /// Adds when the coils were told to be at zero [s], by steady_seconds(), and brings the log to
  /// its place. Why it cannot be there, or nothing.
  std::string finish(double zero_at, bool confirmed) noexcept;

 private:
  void write(const std::string& text);

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::ofstream out_;
  std::size_t coils_;
  bool dry_;
  double began_ = 0;
};

}  // namespace microswarm
