// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace microswarm {

/// Folder from which file names in an input file count: that of the file, or the working folder for
/// standard input and pipes of the shell ("/dev/stdin", "/dev/fd/63").
inline std::filesystem::path input_folder(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  const bool is_pipe = file == "/dev/stdin" || folder == "/dev/fd" || folder == "/proc/self/fd";
  return is_pipe ? std::filesystem::path() : folder;
}

}  // namespace microswarm
