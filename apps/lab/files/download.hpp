// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::lab {

/// A file in a separate folder, readable by this user alone; the destructor removes both. The
/// folder is locked, which distinguishes it from leftovers of killed programs.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view name);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor lock_;  ///< the open folder
};

/// Removes leftover folders of this user's killed programs.
void remove_left_folders();

/// Rethrows the issues with the file's name for pages.
[[noreturn]] void throw_renamed(const InputError& error, const std::filesystem::path& file,
                                std::string_view name);

/// Content of a download: bytes, or a temporary file.
struct Download {
  std::string bytes;
  std::unique_ptr<TemporaryFile> file;
};

/// Function that makes the download of that name from a session: record.h5 (so far), scenario.yaml
/// (the initial one, with absolute file names), frames.csv, events.csv. `folder` is the scenario's.
/// Empty for another name.
std::function<Download(const experiment::Session&)> download(std::string_view name,
                                                             const std::filesystem::path& folder);
std::string_view find_media_type(std::string_view name);

}  // namespace microswarm::lab
