// SPDX-License-Identifier: Apache-2.0
// What the samples of a TIFF's pixel are, and the picture they show; for its reader only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace microswarm::formats::tiff {

/// Meaning of the samples of a pixel, by the photometric interpretation and the extra samples.
struct PixelSamples {
  int colours = 1;          ///< samples of a colour: 1 (grey, or an index), 3 (RGB) or 4 (CMYK)
  int channels = 1;         ///< grey ones of which one is shown
  int alpha = -1;           ///< index of the sample that is the opacity; -1: none
  bool multiplied = false;  ///< colours are multiplied by the opacity
  int unknown = 0;          ///< samples of unknown meaning

  /// Of grey (`colours` 1) or of others, `samples` in all, whose last ones are `extra` (their kinds
  /// in TIFF: 0, 1 multiplied by the opacity, 2 not).
  static PixelSamples of(int samples, int colours, bool is_grey,
                         std::span<const std::uint16_t> extra) {
    PixelSamples pixel{.colours = colours};
    const int first = samples - static_cast<int>(extra.size());
    for (std::size_t i = 0; i < extra.size() && pixel.alpha < 0; ++i)
      if (extra[i] == 1 || extra[i] == 2) {
        pixel.alpha = first + static_cast<int>(i);
        pixel.multiplied = extra[i] == 1;
      }
    const int others = samples - colours - (pixel.alpha < 0 ? 0 : 1);
    // Channels before the opacity.
    if (is_grey && others > 0 && (pixel.alpha < 0 || pixel.alpha == samples - 1))
      pixel.channels = 1 + others;
    else
      pixel.unknown = std::max(0, others);
    return pixel;
  }
};

/// Puts colours in front of white: `full` is white, and the opacity of what is not transparent.
template <class Sample>
void put_over_white(std::vector<Sample>& samples, const std::vector<Sample>& alpha,
                    std::size_t channels, bool multiplied, double full) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double a = std::clamp(static_cast<double>(alpha[i / channels]), 0.0, full);
    const auto s = static_cast<double>(samples[i]);
    const double shown = multiplied ? s + full - a : (s * a + full * (full - a)) / full;
    if constexpr (std::is_integral_v<Sample>)
      samples[i] = static_cast<Sample>(std::lround(std::clamp(shown, 0.0, full)));
    else
      samples[i] = static_cast<Sample>(shown);
  }
}

/// Red, green and blue of cyan, magenta, yellow and black, as libtiff shows those of 8 bits.
template <class Sample>
std::vector<Sample> rgb_of_cmyk(const std::vector<Sample>& cmyk, std::uint32_t full) {
  std::vector<Sample> rgb;
  rgb.reserve(cmyk.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < cmyk.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c)
      rgb.push_back(
          static_cast<Sample>(std::uint64_t{full - cmyk[i + c]} * (full - cmyk[i + 3]) / full));
  return rgb;
}

/// The opacity of what is not transparent: 1 of floating samples, unless some are above it.
inline double full_opacity(std::span<const float> alpha) {
  float most = 0;
  for (const float a : alpha)
    if (std::isfinite(a)) most = std::max(most, a);
  return most <= 1 ? 1 : most <= 255 ? 255 : 65535;
}

}  // namespace microswarm::formats::tiff
