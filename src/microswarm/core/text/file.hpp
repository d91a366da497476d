// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {

/// Handling of a symbolic link at the target path. Links in the folder's path are always followed.
enum class LinkAtFile {
  followed,
  refused,  ///< for reading an error; a written file takes its place
};

/// All bytes of a file. Throws InputError "PATH: cannot read: REASON", also for a folder and for a
/// file larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 1ULL << 30,
                      LinkAtFile link = LinkAtFile::followed);

/// At most the first bytes of a file; empty for one that cannot be read.
std::string read_begin(const std::filesystem::path& path, std::size_t most);

/// Extension of a file's name in small letters: ".png".
std::string lower_extension(const std::filesystem::path& path);

/// A file written under a temporary name and renamed when complete. Write to `path()`, which is in
/// the target's folder and keeps its extension, then call `commit()`. A reader sees the old file or
/// the whole new one, never a part; without commit() nothing is left behind. Throws InputError
/// "TARGET: cannot write: REASON". A target that is not a regular file, such as /dev/stdout, is
/// written directly, unless links are refused: then it is replaced.
class StagedFile {
 public:
  explicit StagedFile(std::filesystem::path target, LinkAtFile link = LinkAtFile::followed);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  const std::filesystem::path& path() const { return staged_; }
  /// Flushes the bytes to the disk (fsync), then renames to the target.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staged_;
  bool direct_ = false;
  bool committed_ = false;
};

/// Removes files that StagedFile left in a folder for processes that no longer exist. Ignores
/// errors.
void clear_staged(const std::filesystem::path& folder);

/// Writes a whole file through a StagedFile. Throws InputError "PATH: cannot write: REASON", for
/// example "No space left on device".
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           LinkAtFile link = LinkAtFile::followed);

/// Creates the folder and its parents and tests whether files can be written there. Throws
/// InputError "FOLDER: cannot make the folder: REASON" or "…: cannot write: REASON".
void make_folder(const std::string& folder);

}  // namespace microswarm
