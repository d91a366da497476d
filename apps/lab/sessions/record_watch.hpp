// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace microswarm::lab {

/// File to open for a record: the record, or the part that its run writes if it does not exist yet.
std::filesystem::path present_record(const std::filesystem::path& record);

/// Watches a record that a run is still writing: a part file (microswarm::part_file), which is
/// replaced repeatedly, and removed when the record is complete. Other files never change.
class RecordWatch {
 public:
  explicit RecordWatch(std::filesystem::path file);

  /// File to read now: the part while it exists, then the complete record.
  std::filesystem::path file() const;
  /// Whether a run is still writing it.
  bool is_growing() const;
  /// Whether the file was replaced since the last call; true at the first call.
  bool has_changed();

 private:
  struct Version {
    std::filesystem::path file;
    ino_t number = 0;
    timespec time{};
    off_t size = 0;
  };
  std::filesystem::path part_;
  std::filesystem::path whole_;  ///< empty unless the file is a part
  Version last_;
};

}  // namespace microswarm::lab
