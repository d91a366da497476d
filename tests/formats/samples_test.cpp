// SPDX-License-Identifier: Apache-2.0
// Pictures in memory.
#include "microswarm/formats/images/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {
namespace {

TEST(Samples, OfEightBitsAreCopied) {
  const std::vector<std::uint8_t> samples{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  Image image;
  take_samples(Samples2d<std::uint8_t>{samples, 2, 2, 3}, "picture", image);
  EXPECT_EQ(image.pixels, samples);
  EXPECT_EQ(image.channels, 3);
  EXPECT_THROW(take_samples(Samples2d<std::uint8_t>{samples, 2, 2, 2}, "p", image), InputError);
  EXPECT_THROW(take_samples(Samples2d<std::uint8_t>{samples, 3, 2, 1}, "p", image), InputError);
  EXPECT_THROW(take_samples(Samples2d<std::uint8_t>{{}, 0, 2, 1}, "p", image), InputError);
  EXPECT_THROW(take_samples(Samples2d<std::uint8_t>{{}, 1 << 20, 1, 1}, "p", image), InputError);
  EXPECT_EQ(image.pixels, samples);
}

TEST(Samples, OfSixteenBitsAreScaledByTheirDepth) {
  const std::vector<std::uint16_t> samples{0, 1000, 4095, 2048};
  EXPECT_EQ(used_depth(samples), 12);
  EXPECT_EQ(used_depth({}), 8);
  Image image;
  take_samples(Samples2d<std::uint16_t>{samples, 4, 1, 1}, 12, "picture", image);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(image.pixels[i], std::lround(samples[i] * 255.0 / 4095)) << i;
  take_samples(Samples2d<std::uint16_t>{samples, 4, 1, 1}, 10, "picture", image);
  EXPECT_EQ(image.pixels[2], 255);
}

}  // namespace
}  // namespace microswarm::formats
