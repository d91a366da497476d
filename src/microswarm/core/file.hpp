// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "microswarm/core/error.hpp"

namespace microswarm {

/// All bytes of a file. Throws InputError "PATH: cannot read: REASON", also for a folder and for a
/// file of more than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 1ULL << 30);

/// A file in the making: write to `path()`, which stands beside the target and keeps its
/// extension, then `commit()`. A reader sees the old file or the whole new one, never a part; when
/// commit() was not reached, nothing is left behind. Errors are InputError "TARGET: cannot write:
/// REASON". A target that is no plain file, as /dev/stdout, is written to straight away.
class StagedFile {
 public:
  explicit StagedFile(std::filesystem::path target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  const std::filesystem::path& path() const { return staged_; }
  /// Brings the bytes to the disk (fsync), then renames to the target.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staged_;
  bool direct_ = false;
  bool committed_ = false;
};

/// Takes away what StagedFile left in a folder for programs that are no more. Passes over errors.
void clear_staged(const std::filesystem::path& folder);

/// Writes a whole file by way of a StagedFile. Throws InputError "PATH: cannot write: REASON", for
/// example "No space left on device".
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes the folder, with its parents, and tries whether files can be written there. Throws
/// InputError "FOLDER: cannot make the folder: REASON" or "…: cannot write: REASON".
void make_folder(const std::string& folder);

}  // namespace microswarm
