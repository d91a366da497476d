// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spawn.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace microswarm {

/// Starts a program without a shell, in its own process group, with default signals.
class Spawning {
 public:
  Spawning();
  ~Spawning();
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  /// Descriptors that it gets: stdin, stdout, stderr, then `more` as 3, 4, ...; no others.
  void files(int in, int out, int err, const std::vector<int>& more = {});
  /// Folder in which it starts, and in which a relative path of a program is found.
  void folder(const std::filesystem::path& path);
  /// Starts the command, so that it can be waited for, with `variables` (NAME=VALUE) in place of
  /// those of these names. On failure nothing, with errno set.
  std::optional<pid_t> start(std::vector<std::string> command,
                             std::vector<std::string> variables = {});

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace microswarm
