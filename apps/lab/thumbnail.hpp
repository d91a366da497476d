// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace microswarm::lab {

/// A small drawing (SVG, at most 320 × 240 pixels) of a scenario's walls, its obstacles at t = 0,
/// starts and goals; transparent where the world is free. What would be smaller than half a pixel
/// is left out. Throws InputError like open_session.
std::string thumbnail(const std::filesystem::path& scenario);

/// Drawings by file, made anew when the file has changed. Use it from one thread.
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
