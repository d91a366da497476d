// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace microswarm::lab {

/// The file to open for a record: itself, or if it is not there yet the part that its run writes.
std::filesystem::path present_record(const std::filesystem::path& record);

/// Watches a record that its run is still writing: a part file (microswarm::part_of), which is
/// replaced again and again, and removed when the whole record is there. Another file never
/// changes.
class RecordWatch {
 public:
  explicit RecordWatch(std::filesystem::path file);

  /// What is to be read now: the part while it is there, then the whole.
  std::filesystem::path file() const;
  /// Whether a run is still writing it.
  bool is_growing() const;
  /// Whether the file was replaced since the last call, or is looked at for the first time.
  bool has_changed();

 private:
  struct Version {
    std::filesystem::path file;
    ino_t number = 0;
    timespec time{};
    off_t size = 0;
  };
  std::filesystem::path part_;
  std::filesystem::path whole_;  ///< empty: it is not a part
  Version last_;
};

}  // namespace microswarm::lab
