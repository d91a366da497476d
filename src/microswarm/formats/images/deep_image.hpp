// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Image with 9 to 16 bits per sample, in the order of Image.
struct DeepImage {
  int width = 0;
  int height = 0;
  int channels = 1;                    ///< 1 (grey) or 3 (red, green, blue)
  std::vector<std::uint16_t> samples;  ///< width · height · channels
};

/// A picture as its file stores it.
using DecodedImage = std::variant<Image, DeepImage>;

}  // namespace microswarm::formats
