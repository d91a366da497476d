// SPDX-License-Identifier: Apache-2.0
// Channels of chips: two greys under uneven light, in noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "microswarm/vision/image/along_lines.hpp"
#include "microswarm/vision/image/total_variation.hpp"
#include "microswarm/vision/vessels/agreement.hpp"
#include "microswarm/vision/vessels/light_fit.hpp"
#include "microswarm/vision/vessels/two_levels.hpp"
#include "microswarm/vision/vessels/vessels.hpp"
#include "tests/cases.hpp"
#include "tests/vision/drawn_chips.hpp"

namespace microswarm::vision {
namespace {

using test::Chip;
using test::ChipLooks;

double dice(const Chip& chip, const VesselSegmentation& found) {
  return compare(chip.truth, found.vessels).dice().value_or(0);
}

formats::Image inverse_of(formats::Image picture) {
  for (std::uint8_t& sample : picture.pixels) sample = static_cast<std::uint8_t>(255 - sample);
  return picture;
}

TEST(Chips, ChannelsAreFoundWhateverLightNoiseAndTone) {
  for (int seed = 1; seed <= test::cases(40); ++seed) {
    const ChipLooks looks = test::chip_looks(seed);
    const Chip chip = test::draw_chip(looks, seed);
    const VesselSegmentation found = segment_vessels(chip.picture);
    EXPECT_GE(dice(chip, found), 0.93) << chip.name << ": " << describe_choice(found);
    EXPECT_EQ(found.method, VesselMethod::regions) << chip.name;
    EXPECT_EQ(note_on_noise(found), "") << chip.name;
    EXPECT_EQ(found.polarity, looks.contrast > 0 ? Polarity::dark : Polarity::bright) << chip.name;
  }
}

// Single pixels tell nothing here; lines do. At 6 px and noise 25 one in some is lost, and told.
TEST(Chips, NarrowChannelsFainterThanTheNoiseAreFound) {
  int right = 0;
  for (const double contrast : {20.0, -20.0})
    for (const double width : {6.0, 8.0})
      for (const double noise : {20.0, 25.0})
        for (const std::uint64_t seed : {31, 33}) {
          ChipLooks looks{.contrast = contrast, .noise = noise, .light = 40};
          looks.width = 640, looks.height = 500;
          looks.min_width = looks.max_width = width;
          looks.shape = seed == 31 ? ChipLooks::Shape::curved : ChipLooks::Shape::branching;
          const Chip chip = test::draw_chip(looks, seed);
          const VesselSegmentation found = segment_vessels(chip.picture);
          const bool is_right = dice(chip, found) >= 0.9;
          right += is_right;
          EXPECT_TRUE(is_right || !note_on_noise(found).empty()) << chip.name;
          EXPECT_TRUE(is_right || (width < 8 && noise > 20)) << chip.name;
        }
  EXPECT_GE(right, 14);  // of 16
}

TEST(Chips, WhatNoiseHidesIsTold) {
  int untold = 0;
  for (const double contrast : {11.0, -11.0})
    for (const double width : {4.0, 8.0})
      for (const std::uint64_t seed : {41, 42}) {
        ChipLooks looks{.contrast = contrast, .noise = 25, .light = 20};
        looks.min_width = looks.max_width = width;
        const Chip chip = test::draw_chip(looks, seed);
        const VesselSegmentation found = segment_vessels(chip.picture);
        untold += dice(chip, found) < 0.9 && note_on_noise(found).empty();
      }
  EXPECT_LE(untold, 1);  // of 8: noise that two levels seem to explain
}

TEST(Chips, WidthsAreRightOnACleanGroundInUnevenLight) {
  for (const double light : {0.0, 20.0, 40.0})
    for (const double contrast : {60.0, -60.0}) {
      ChipLooks looks{.contrast = contrast, .noise = 2, .light = light};
      looks.shape = ChipLooks::Shape::straight;
      looks.min_width = looks.max_width = 20;
      const Chip chip = test::draw_chip(looks, 3);
      const VesselSegmentation found = segment_vessels(chip.picture);
      EXPECT_GT(dice(chip, found), 0.98) << chip.name;
      EXPECT_NEAR(found.wide_width_px, 20, 2) << chip.name;
    }
}

// A clean ground has a tiny spread of line scores: the flanks of the filter's answer are no lines.
TEST(Chips, LinesAreNotTwiceAsWide) {
  ChipLooks looks{.width = 500, .height = 400, .contrast = 70, .noise = 4, .light = 20};
  const Chip chip = test::draw_chip(looks, 5);
  const VesselSegmentation found = segment_vessels(chip.picture, {.method = VesselMethod::lines});
  EXPECT_GT(dice(chip, found), 0.85);
  EXPECT_FALSE(found.two_level_share);
}

TEST(Chips, TheToneOfLinesIsThatOfTheLinesThatStandOut) {
  ChipLooks looks{.width = 500, .height = 400, .contrast = 50, .noise = 8, .light = 30};
  looks.max_width = 9;
  for (const std::uint64_t seed : {7, 8, 9}) {
    const Chip chip = test::draw_chip(looks, seed);
    const VesselParams lines{.method = VesselMethod::lines};
    EXPECT_EQ(segment_vessels(chip.picture, lines).polarity, Polarity::dark) << seed;
    const VesselSegmentation bright = segment_vessels(inverse_of(chip.picture), lines);
    EXPECT_EQ(bright.polarity, Polarity::bright) << seed;
    EXPECT_GT(bright.polarity_odds.value_or(0), 1.2) << seed;
    EXPECT_GT(dice(chip, bright), 0.7) << seed;
  }
}

// A channel that is nearly black is no surround of a field of view.
TEST(Chips, BlackChannelsAreFound) {
  formats::Image picture{400, 300, 1, std::vector<std::uint8_t>(400 * 300, 200)};
  formats::Mask truth(400, 300);
  for (int row = 0; row < 300; ++row)
    for (int column = 0; column < 400; ++column) {
      const bool channel = column < 280 && std::abs(row - 140) < 9;
      truth.at(column, row) = channel;
      if (channel) picture.pixels[picture.index(column, row)] = 5;
    }
  const VesselSegmentation found = segment_vessels(picture);
  EXPECT_GT(compare(truth, found.vessels).dice().value_or(0), 0.97) << describe_choice(found);
}

// Light and noise alone are no two greys, however uneven the light is.
TEST(Chips, AnEmptyPictureHasNoLevels) {
  for (const double noise : {2.0, 10.0, 25.0}) {
    ChipLooks looks{.contrast = 0, .noise = noise, .light = 40};
    for (const bool quadratic : {false, true}) {
      looks.quadratic = quadratic;
      const VesselSegmentation found = segment_vessels(test::draw_chip(looks, 2).picture);
      EXPECT_LT(found.two_level_share.value_or(1), 0.5) << noise;
      EXPECT_EQ(found.method, VesselMethod::lines) << noise;
    }
  }
}

// All first sets are tried unless one explains a picture that is clear of its noise.
TEST(Chips, OnlyAClearPictureIsFittedOnce) {
  const auto tried = [](const formats::Image& picture) {
    const cv::Mat grey(picture.height, picture.width, CV_8U,
                       const_cast<std::uint8_t*>(picture.pixels.data()));
    return fit_two_levels(grey, cv::Mat(grey.size(), CV_8U, cv::Scalar(255))).tried;
  };
  EXPECT_EQ(tried(test::draw_chip({.contrast = 80, .noise = 3, .light = 20}, 3).picture), 1);
  // Few levels of noise, which hides what else there could be: once more along lines.
  EXPECT_EQ(tried(test::draw_chip({.contrast = 30, .noise = 20, .light = 20}, 3).picture), 12);
  // Fine texture that two levels explain in part.
  ChipLooks looks{.contrast = 80, .noise = 3, .light = 20};
  formats::Image shaded = test::draw_chip(looks, 3).picture;
  for (int row = 0; row < shaded.height; ++row)
    for (int column = 0; column < shaded.width; ++column) {
      auto& pixel = shaded.pixels[shaded.index(column, row)];
      const double wave = 25 * std::sin(0.15 * column) * std::sin(0.15 * row);
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + wave, 0.0, 255.0));
    }
  EXPECT_EQ(tried(shaded), 6);
}

TEST(Chips, TheChoiceIsDescribedAndItsDoubtsAre) {
  VesselSegmentation found;
  found.method = VesselMethod::regions;
  found.polarity = Polarity::bright;
  EXPECT_EQ(describe_choice(found), "regions, bright");
  found.two_level_share = 0.99;
  found.polarity_odds = 5;
  EXPECT_EQ(describe_choice(found), "regions, bright");
  found.two_level_share = 0.92;
  EXPECT_NE(describe_choice(found).find("92 %"), std::string::npos);
  EXPECT_NE(describe_choice(found).find("method=lines"), std::string::npos);
  found.two_level_share = 0.99;
  found.polarity_odds = 1.1;
  EXPECT_NE(describe_choice(found).find("polarity=dark"), std::string::npos);
}

TEST(Chips, WhatIsSetIsTaken) {
  const Chip chip = test::draw_chip({.contrast = 70}, 4);
  const VesselSegmentation found = segment_vessels(
      chip.picture, {.method = VesselMethod::regions, .polarity = Polarity::bright});
  EXPECT_EQ(found.polarity, Polarity::bright);
  EXPECT_FALSE(found.two_level_share || found.polarity_odds);
  EXPECT_LT(dice(chip, found), 0.2);
}

// The exact minimum for a step of one between n pixels on either side: both levels move by
// weight/n.
TEST(WithoutNoise, MovesTheLevelsOfAStepButNotItsPlace) {
  constexpr int n = 8;
  constexpr double weight = 0.4;
  cv::Mat step(5, 2 * n, CV_32F, cv::Scalar(0));
  step.colRange(n, 2 * n) = 1;
  for (const cv::Mat& picture : {step, cv::Mat(step.t())}) {
    const cv::Mat u = without_noise(picture, weight, 400);
    for (int y = 0; y < u.rows; ++y)
      for (int x = 0; x < u.cols; ++x) {
        const bool high = picture.at<float>(y, x) > 0.5F;
        EXPECT_NEAR(u.at<float>(y, x), high ? 1 - weight / n : weight / n, 1e-3);
      }
  }
}

TEST(WithoutNoise, KeepsTheMeanAndRemovesNoise) {
  Rng rng(1, Purpose::test);
  cv::Mat noise(60, 70, CV_32F);
  for (int i = 0; i < 60 * 70; ++i)
    noise.at<float>(i / 70, i % 70) = static_cast<float>(rng.normal());
  const cv::Mat u = without_noise(noise, 1, 100);
  EXPECT_NEAR(cv::mean(u)[0], cv::mean(noise)[0], 1e-4);
  EXPECT_LT(cv::norm(u), 0.25 * cv::norm(noise));
  EXPECT_EQ(cv::norm(without_noise(noise, 0, 100), noise), 0);
}

// A line whose noise is 1.25 times its contrast, and a flat picture.
TEST(AveragedAlong, KeepsLinesAndRemovesNoise) {
  Rng rng(2, Purpose::test);
  cv::Mat noisy(120, 120, CV_32F);
  for (int y = 0; y < noisy.rows; ++y)
    for (int x = 0; x < noisy.cols; ++x)
      noisy.at<float>(y, x) =
          static_cast<float>((std::abs(x - y) < 5 ? 1 : 0) + 1.25 * rng.normal());
  const cv::Mat u = averaged_along(noisy, 0.7, 10);
  double least = 1, most = 0;
  for (int i = 25; i < 95; ++i) {
    least = std::min<double>(least, u.at<float>(i, i));
    if (i < 80) most = std::max<double>(most, u.at<float>(i, i + 15));
  }
  EXPECT_GT(least, 0.5);
  EXPECT_LT(most, 0.5);
  const cv::Mat flat(30, 40, CV_32F, cv::Scalar(3));
  EXPECT_NEAR(cv::norm(averaged_along(flat, 0.7, 5), flat, cv::NORM_INF), 0, 1e-4);
}

TEST(FitLight, FindsPolynomialsOfLightAndContrast) {
  const cv::Size size(90, 70);
  const LightPolynomial light{2, {100, 10, -5, 3, 2, -8}};
  const LightPolynomial contrast{1, {30, 4, -6}};
  cv::Mat set(size, CV_32F, cv::Scalar(0));
  set.colRange(20, 60) = 1;
  const cv::Mat grey = light.over(size) + contrast.over(size).mul(set);
  const LightFit fit = fit_light(grey, set, cv::Mat(size, CV_8U, cv::Scalar(255)), 2, 1);
  for (std::size_t i = 0; i < light.factors.size(); ++i)
    EXPECT_NEAR(fit.light.factors[i], light.factors[i], 0.5) << i;
  for (std::size_t i = 0; i < contrast.factors.size(); ++i)
    EXPECT_NEAR(fit.contrast.factors[i], contrast.factors[i], 0.5) << i;
}

}  // namespace
}  // namespace microswarm::vision
