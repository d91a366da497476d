// SPDX-License-Identifier: Apache-2.0
// Samples in the rows of a TIFF, for its reader only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace microswarm::formats::tiff {

/// Layout of samples in a row: of all channels, or of one plane.
struct SampleRow {
  int bits = 16;
  int step = 1;    ///< samples a pixel
  int plane = -1;  ///< plane of the only sample; -1: all channels
  int first = 0;   ///< sample of a pixel that is the first channel

  std::uint16_t plane_number() const { return static_cast<std::uint16_t>(std::max(plane, 0)); }
  /// Size of a row [B].
  std::size_t bytes(std::uint32_t pixels) const {
    return (std::size_t{pixels} * static_cast<std::size_t>(step * bits) + 7) / 8;
  }
};

/// Unsigned samples of 1 to 16 bits. Those of 16 bits have the computer's byte order; others are
/// packed, high bits first.
struct PackedSamples {
  int bits = 16;
  std::uint16_t operator()(const std::uint8_t* row, std::size_t sample) const {
    if (bits == 16) {
      std::uint16_t value = 0;
      std::memcpy(&value, row + 2 * sample, sizeof value);
      return value;
    }
    std::uint32_t value = 0;
    const std::size_t first = sample * static_cast<std::size_t>(bits);
    const std::size_t end = first + static_cast<std::size_t>(bits);
    for (std::size_t byte = first / 8; 8 * byte < end; ++byte) value = value << 8 | row[byte];
    const std::size_t after = (8 - end % 8) % 8;
    return static_cast<std::uint16_t>(value >> after & ((1u << bits) - 1));
  }
};

/// Samples of a type of the computer, in its byte order.
template <class Stored>
struct PlainSamples {
  float operator()(const std::uint8_t* row, std::size_t sample) const {
    Stored value{};
    std::memcpy(&value, row + sizeof(Stored) * sample, sizeof value);
    return static_cast<float>(value);
  }
};

/// Writes the samples of a picture, which `out` holds row by row.
template <class Sample, class Reader>
struct SamplePlacer {
  SampleRow row{};
  Reader read{};
  Sample* out;
  std::size_t width;     ///< of the picture [px]
  std::size_t channels;  ///< of the picture

  /// Copies `count` pixels that begin at `bytes` to column `x` of row `y`.
  void place(const std::uint8_t* bytes, std::uint32_t x, std::uint32_t y,
             std::uint32_t count) const {
    Sample* to = out + (y * width + x) * channels;
    for (std::size_t i = 0; i < count; ++i, to += channels) {
      const std::size_t first = i * static_cast<std::size_t>(row.step) +
                                static_cast<std::size_t>(row.plane < 0 ? row.first : 0);
      if (row.plane >= 0)
        to[row.plane - row.first] = static_cast<Sample>(read(bytes, first));
      else
        for (std::size_t c = 0; c < channels; ++c)
          to[c] = static_cast<Sample>(read(bytes, first + c));
    }
  }
};

}  // namespace microswarm::formats::tiff
