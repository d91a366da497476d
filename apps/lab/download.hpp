// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm::lab {

/// A file in a folder of its own, readable by this user alone, both removed with this object. The
/// folder is locked, which tells it from one that a killed program left.
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

/// Removes the folders of temporary files that killed programs of this user left.
void remove_left_folders();

/// Throws the error again, with the file named as a page knows it.
[[noreturn]] void throw_renamed(const InputError& error, const std::filesystem::path& file,
                                std::string_view name);

/// Contents of a file for a page: bytes, or a temporary file.
struct Download {
  std::string bytes;
  std::unique_ptr<TemporaryFile> file;
};

/// How a session becomes the download of that name: record.h5 (so far), scenario.yaml (the initial
/// one, with absolute names of its files), frames.csv, events.csv. `folder` is the scenario's.
/// Empty for another name.
std::function<Download(const Session&)> download(std::string_view name,
                                                 const std::filesystem::path& folder);
std::string_view media_type_of(std::string_view name);

}  // namespace microswarm::lab
