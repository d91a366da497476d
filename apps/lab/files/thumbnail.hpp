// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace microswarm::lab {

/// A small drawing (SVG, at most 320 × 240 pixels) of a scenario's walls, its obstacles at t = 0,
/// starts and goals, of a record also the path travelled; transparent where the world is free.
/// Details smaller than half a pixel are omitted. Throws InputError like open_session.
std::string thumbnail(const std::filesystem::path& file);

/// Cache of drawings by file, renewed after a change of the file. Not thread-safe.
class Thumbnails {
 public:
  const std::string& of(const std::filesystem::path& scenario);

 private:
  struct Drawn {
    std::filesystem::file_time_type written;
    std::string svg;
  };
  std::map<std::filesystem::path, Drawn> drawn_;
};

}  // namespace microswarm::lab
