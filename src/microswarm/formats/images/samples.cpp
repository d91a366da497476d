// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/samples.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {
namespace {

template <class Sample>
void check(const Samples2d<Sample>& picture, std::string_view name) {
  check_image_size(picture.width, picture.height, name);
  if (picture.channels != 1 && picture.channels != 3)
    throw InputError(std::string(name) + ": " + std::to_string(picture.channels) +
                     " channels, must be 1 or 3");
  const auto pixels = static_cast<std::size_t>(picture.width) * picture.height;
  if (picture.samples.size() != pixels * picture.channels)
    throw InputError(std::string(name) + ": " + std::to_string(picture.samples.size()) +
                     " samples, the sizes say " + std::to_string(pixels * picture.channels));
}

}  // namespace

int used_depth(std::span<const std::uint16_t> samples) {
  const std::uint16_t largest = samples.empty() ? 0 : *std::ranges::max_element(samples);
  return std::clamp(static_cast<int>(std::bit_width(largest)), 8, 16);
}

void to_8_bits(std::span<const std::uint16_t> samples, int depth, std::span<std::uint8_t> out) {
  // Added to a number below 2^22, it leaves the nearest whole one in the low bits.
  constexpr float rounding = 0x1.8p23F;
  const auto scale = static_cast<float>(255.0 / ((1 << depth) - 1));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float shifted = static_cast<float>(samples[i]) * scale + rounding;
    const std::uint32_t whole = std::bit_cast<std::uint32_t>(shifted) & 0xffffU;
    out[i] = static_cast<std::uint8_t>(std::min(whole, 255U));
  }
}

void take_samples(const Samples2d<std::uint8_t>& picture, std::string_view name, Image& image) {
  check(picture, name);
  image.width = picture.width;
  image.height = picture.height;
  image.channels = picture.channels;
  image.pixels.assign(picture.samples.begin(), picture.samples.end());
}

void take_samples(const Samples2d<std::uint16_t>& picture, int depth, std::string_view name,
                  Image& image) {
  check(picture, name);
  image.width = picture.width;
  image.height = picture.height;
  image.channels = picture.channels;
  image.pixels.resize(picture.samples.size());
  to_8_bits(picture.samples, depth, image.pixels);
}

}  // namespace microswarm::formats
