// SPDX-License-Identifier: Apache-2.0
// What a source of pictures shows and says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "tests/files.hpp"

namespace microswarm::vision {

namespace fs = std::filesystem;

/// Everything that a source tells.
struct Seen {
  std::vector<double> times;
  std::vector<int> greys;  ///< of a pixel of each picture
  std::vector<std::string> notes;
  std::string why_ended;
  std::optional<int> count;
};

inline Seen see(const fs::path& source, const FrameOptions& options = {}) {
  const auto frames = open_frames(source, options);
  Seen seen;
  VideoFrame frame;
  while (frames->next(frame)) {
    seen.times.push_back(frame.t);
    seen.greys.push_back(frame.picture.pixels[frame.picture.pixels.size() / 2]);
  }
  seen.notes = frames->notes();
  seen.why_ended = frames->why_ended();
  seen.count = frames->count();
  return seen;
}

/// A folder of pictures of these names.
inline void write_pictures(const test::Folder& folder, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    formats::write_png(folder / names[k],
                       {2, 1, 1, std::vector<std::uint8_t>(2, static_cast<std::uint8_t>(k))});
}

}  // namespace microswarm::vision
