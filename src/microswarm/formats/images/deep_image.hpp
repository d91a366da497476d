// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Image with 9 to 16 bits per sample, in the order of Image.
struct DeepImage {
  int width = 0;
  int height = 0;
  int channels = 1;                      ///< 1 (grey) or 3 (red, green, blue)
  std::vector<std::uint16_t> samples{};  ///< width · height · channels
  int bits = 16;                         ///< in which the file stores a sample
};

/// Image whose samples are signed, of more than 16 bits, or no whole numbers; in the order of
/// Image.
struct RealImage {
  int width = 0;
  int height = 0;
  int channels = 1;              ///< 1 (grey) or 3 (red, green, blue)
  std::vector<float> samples{};  ///< width · height · channels; may be infinite or no number
  std::string_view kind{};       ///< of the samples: "32-bit float"
};

/// A picture as its file stores it.
using DecodedImage = std::variant<Image, DeepImage, RealImage>;

}  // namespace microswarm::formats
