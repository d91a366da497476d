// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"

namespace microswarm::formats {
namespace {

template <class Sample>
void check(const Samples2d<Sample>& picture, std::string_view name) {
  check_image_size(picture.width, picture.height, name);
  if (picture.channels != 1 && picture.channels != 3)
    throw InputError(std::string(name),
                     std::to_string(picture.channels) + " channels, must be 1 or 3");
  const auto pixels = static_cast<std::size_t>(picture.width) * picture.height;
  if (picture.samples.size() != pixels * picture.channels)
    throw InputError(std::string(name), std::to_string(picture.samples.size()) +
                                            " samples, the sizes say " +
                                            std::to_string(pixels * picture.channels));
}

template <class Picture>
void take_shape(const Picture& picture, Image& image) {
  image.width = picture.width;
  image.height = picture.height;
  image.channels = picture.channels;
  image.pixels.resize(picture.samples.size());
}

std::size_t scale_samples(std::span<const float> samples, const GreyScale& scale,
                          std::span<std::uint8_t> out) {
  const double factor = scale.white > scale.black ? 255 / (scale.white - scale.black) : 0;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto value = static_cast<double>(samples[i]);
    beyond += value < scale.black || value > scale.white;
    const double grey = (value - scale.black) * factor;
    out[i] = grey > 0 ? static_cast<std::uint8_t>(std::lround(std::min(grey, 255.0))) : 0;
  }
  return beyond;
}

/// Range of the finite samples, and whether all samples are whole.
struct SampleRange {
  float least = 0, most = 0;
  bool any = false, whole = true;
};

SampleRange range_of(std::span<const float> samples) {
  SampleRange range;
  for (const float value : samples) {
    if (!std::isfinite(value)) continue;
    range.least = range.any ? std::min(range.least, value) : value;
    range.most = range.any ? std::max(range.most, value) : value;
    range.whole = range.whole && value == std::floor(value);
    range.any = true;
  }
  return range;
}

GreyScale scale_of_real(std::span<const float> samples) {
  const SampleRange range = range_of(samples);
  if (range.whole && range.least >= 0 && range.most > 1 && range.most <= 65535)
    return GreyScale::of_depth(
        std::max<int>(8, std::bit_width(static_cast<std::uint32_t>(range.most))));
  return {static_cast<double>(range.least), static_cast<double>(range.most)};
}

std::string note_on_deep(const DeepImage& deep, const GreyScale& scale) {
  if (scale.white >= (1 << deep.bits) - 1) return {};
  return fmt::format("its {}-bit samples are read as numbers of {} bits: {:.0f} is white",
                     deep.bits, std::bit_width(static_cast<unsigned>(scale.white)), scale.white);
}

std::string note_on_real(const RealImage& real, const GreyScale& scale) {
  return fmt::format("its {} samples are scaled: {:.6g} is black, {:.6g} is white", real.kind,
                     scale.black, scale.white);
}

std::string note_on_no_numbers(std::span<const float> samples) {
  const auto count =
      std::ranges::count_if(samples, [](float sample) { return std::isnan(sample); });
  if (count == 0) return {};
  return fmt::format("{} of its samples are no number (NaN): they are read as black", count);
}

std::size_t take_real(const RealImage& real, const GreyScale& scale, Image& image) {
  take_shape(real, image);
  return scale_samples(real.samples, scale, image.pixels);
}

std::size_t take_deep(const DeepImage& deep, const GreyScale& scale, Image& image) {
  take_shape(deep, image);
  if (const int depth = std::bit_width(static_cast<std::uint32_t>(scale.white));
      scale.black == 0 && scale.white == (1 << depth) - 1) {
    to_8_bits(deep.samples, depth, image.pixels);
    return static_cast<std::size_t>(std::ranges::count_if(
        deep.samples, [&](std::uint16_t sample) { return sample > scale.white; }));
  }
  const std::vector<float> samples(deep.samples.begin(), deep.samples.end());
  return scale_samples(samples, scale, image.pixels);
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

GreyScale scale_of(const DecodedImage& picture) {
  return std::visit(Overloaded([](const Image&) { return GreyScale::of_depth(8); },
                               [](const DeepImage& deep) {
                                 return GreyScale::of_depth(used_depth(deep.samples));
                               },
                               [](const RealImage& real) { return scale_of_real(real.samples); }),
                    picture);
}

std::string scale_note(const DecodedImage& picture, const GreyScale& scale) {
  return std::visit(Overloaded([](const Image&) { return std::string(); },
                               [&](const DeepImage& deep) { return note_on_deep(deep, scale); },
                               [&](const RealImage& real) { return note_on_real(real, scale); }),
                    picture);
}

std::string no_number_note(const DecodedImage& picture) {
  return std::visit(
      Overloaded([](const OneOf<Image, DeepImage> auto&) { return std::string(); },
                 [](const RealImage& real) { return note_on_no_numbers(real.samples); }),
      picture);
}

std::size_t take_pixels(DecodedImage decoded, const GreyScale& scale, Image& image) {
  return std::visit(Overloaded(
                        [&](Image& plain) {
                          image = std::move(plain);
                          return std::size_t{0};
                        },
                        [&](const DeepImage& deep) { return take_deep(deep, scale, image); },
                        [&](const RealImage& real) { return take_real(real, scale, image); }),
                    decoded);
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
