// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/deep_image.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Samples of a picture in memory: row by row, y down, 1 or 3 of them for a pixel (red, green,
/// blue).
template <class Sample>
struct Samples2d {
  std::span<const Sample> samples{};
  int width = 0;
  int height = 0;
  int channels = 1;
};

/// Bits, 8 to 16, that the largest sample needs.
int used_depth(std::span<const std::uint16_t> samples);

/// Scales numbers of `depth` bits to 8 bits, rounded to the nearest; what is larger becomes 255.
void to_8_bits(std::span<const std::uint16_t> samples, int depth, std::span<std::uint8_t> out);

/// The samples that become 0 and 255 of 8 bits; what lies beyond becomes these.
struct GreyScale {
  double black = 0;
  double white = 65535;

  /// Of numbers of some bits.
  static GreyScale of_depth(int depth) { return {0, static_cast<double>((1 << depth) - 1)}; }
};

/// The scale that shows all samples of a picture: whole numbers from 0 to 65535 have the bits,
/// at least 8, that the largest needs, unless none is above 1; others reach from the smallest to
/// the largest that is finite.
GreyScale scale_of(const DecodedImage& picture);

/// Effect of the scale on the picture's samples, for people: "16-bit samples are read as numbers of
/// 12 bits"; empty if each value keeps its place.
std::string scale_note(const DecodedImage& picture, const GreyScale& scale);

/// Note on the samples that are no number; empty if none is.
std::string no_number_note(const DecodedImage& picture);

/// Moves or scales a picture into `image`, whose memory is used again. Samples that are no number
/// become black. Returns the number of samples beyond the scale.
std::size_t take_pixels(DecodedImage decoded, const GreyScale& scale, Image& image);

/// The picture as an Image, whose memory is used again: copied, or from numbers of `depth` bits as
/// `read_image` scales those of a file. Throws InputError as check_image_size, and unless there are
/// as many samples as the sizes say. `name` stands for the picture in messages.
void take_samples(const Samples2d<std::uint8_t>& picture, std::string_view name, Image& image);
void take_samples(const Samples2d<std::uint16_t>& picture, int depth, std::string_view name,
                  Image& image);

}  // namespace microswarm::formats
