// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "microswarm/formats/media/media.hpp"

namespace microswarm::formats {

HeldPictures held_pictures(int width, int height, unsigned cores) {
  // x264 keeps a picture, its half pixels and its half sizes.
  constexpr std::int64_t bytes_per_px = 6, usual = 64;
  constexpr int usual_ahead = 40, usual_threads = 16, usual_reordered = 3, usual_references = 3;
  const std::int64_t bytes = std::max<std::int64_t>(1, bytes_per_px * width * height);
  const int pictures = static_cast<int>(std::min(usual, max_held_bytes / bytes));
  HeldPictures held;
  held.threads = std::clamp(std::min(static_cast<int>(cores), pictures / 4), 1, usual_threads);
  held.references = std::clamp(pictures / 4, 1, usual_references);
  held.reordered = std::clamp(pictures / 4 - 1, 0, usual_reordered);
  held.ahead =
      std::clamp(pictures - 2 * held.threads - held.references - held.reordered, 0, usual_ahead);
  return held;
}

}  // namespace microswarm::formats
