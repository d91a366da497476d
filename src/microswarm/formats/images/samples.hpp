// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Samples of a picture in memory: row by row, y down, 1 or 3 of them for a pixel (red, green,
/// blue).
template <class Sample>
struct Samples2d {
  std::span<const Sample> samples;
  int width = 0;
  int height = 0;
  int channels = 1;
};

/// Bits, 8 to 16, that the largest sample needs.
int used_depth(std::span<const std::uint16_t> samples);

/// Scales numbers of `depth` bits to 8 bits, rounded to the nearest; what is larger becomes 255.
void to_8_bits(std::span<const std::uint16_t> samples, int depth, std::span<std::uint8_t> out);

/// The picture as an Image, whose memory is used again: copied, or from numbers of `depth` bits as
/// `read_image` scales those of a file. Throws InputError as check_image_size, and unless there are
/// as many samples as the sizes say. `name` stands for the picture in messages.
void take_samples(const Samples2d<std::uint8_t>& picture, std::string_view name, Image& image);
void take_samples(const Samples2d<std::uint16_t>& picture, int depth, std::string_view name,
                  Image& image);

}  // namespace microswarm::formats
