// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/particles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/tracking/band_pass.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"
#include "tests/vision/spots.hpp"

namespace microswarm::vision {
namespace {

/// Root mean square distance of found particles from the true places, each the nearest within 1 px;
/// nothing when one is missing.
std::optional<double> rms_error(const std::vector<Vec2>& truth,
                                const std::vector<Particle>& found) {
  double sum = 0;
  for (const Vec2 p : truth) {
    double least = 1;
    for (const Particle& particle : found)
      least = std::min(least, squared_norm(particle.at_px - p));
    if (least >= 1) return std::nullopt;
    sum += least;
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

TEST(Particles, CentresAreExactToATwentiethOfAPixel) {
  for (const bool dark : {false, true})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      Rng rng(seed, Purpose::test);
      const auto truth = test::scattered(400, 300, 25, rng);
      const formats::Image image =
          test::draw_spots(400, 300, truth, 2.2, dark ? -90 : 90, 1.5, rng);
      ParticleFinder finder({.diameter = 13,
                             .tone = dark ? ParticleTone::dark : ParticleTone::bright,
                             .min_mass = 300});
      const auto& found = finder.find(image);
      EXPECT_EQ(found.size(), truth.size());
      const auto error = rms_error(truth, found);
      ASSERT_TRUE(error) << "seed " << seed;
      EXPECT_LT(*error, 0.05) << "seed " << seed;
    }
}

TEST(Particles, ErrorGrowsWithNoise) {
  double last = 0;
  for (const double noise : {0.5, 4.0, 12.0}) {
    Rng rng(9, Purpose::test);
    const auto truth = test::scattered(400, 300, 25, rng);
    const formats::Image image = test::draw_spots(400, 300, truth, 2.2, 90, noise, rng);
    ParticleFinder finder({.diameter = 13, .tone = ParticleTone::bright, .min_mass = 300});
    const auto error = rms_error(truth, finder.find(image));
    ASSERT_TRUE(error) << noise;
    EXPECT_GT(*error, last);
    last = *error;
  }
}

TEST(Particles, MovedPictureMovesParticles) {
  Rng rng(3, Purpose::test);
  std::vector<Vec2> positions = test::scattered(300, 200, 30, rng);
  ParticleFinder finder({.diameter = 11, .tone = ParticleTone::bright, .min_mass = 300});
  Rng none(1, Purpose::test);
  const formats::Image a = test::draw_spots(300, 200, positions, 2, 80, 0, none);
  const std::vector<Particle> before = finder.find(a);
  for (Vec2& p : positions) p += Vec2{7, 0};
  formats::Image b = a;  // the same pixels, seven columns on
  for (int y = 0; y < 200; ++y)
    for (int x = 7; x < 300; ++x) b.pixels[b.index(x, y)] = a.pixels[a.index(x - 7, y)];
  const std::vector<Particle> after = finder.find(b);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i)
    EXPECT_NEAR(distance(after[i].at_px, before[i].at_px + Vec2{7, 0}), 0, 1e-9);
}

/// Centroid of greys in the round mask about a whole pixel, as trackpy defines it.
Vec2 mask_centroid(const std::vector<int>& greys, int width, int column, int row, int radius) {
  double total = 0;
  Vec2 sum;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy > radius * radius) continue;
      const double grey = greys[static_cast<std::size_t>((row + dy) * width + column + dx)];
      total += grey;
      sum += grey * Vec2{1.0 * (column + dx), 1.0 * (row + dy)};
    }
  return sum / total;
}

/// Spots that fade into each other are where trackpy sees them: a mask between pixels would leave
/// them for their neighbours.
TEST(Particles, FadingSpotsHaveTheCentroidsOfMasksAtWholePixels) {
  const ParticleParams params{.diameter = 11, .tone = ParticleTone::bright, .min_mass = 300};
  Rng rng(21, Purpose::test);
  const auto truth = test::scattered(400, 300, 16, rng);
  const formats::Image image = test::draw_spots(400, 300, truth, 3.5, 90, 3, rng);
  BandPass pass({.noise_px = params.noise,
                 .box_px = params.diameter,
                 .min_foreground = params.min_foreground,
                 .dark_rises = false});
  const std::vector<float> rise = pass.filter(image);
  const float scale = 255 / *std::ranges::max_element(rise);
  std::vector<int> greys;
  for (const float value : rise) greys.push_back(static_cast<int>(scale * value));
  ParticleFinder finder(params);
  const auto& found = finder.find(image);
  EXPECT_GT(found.size(), 300U);
  for (const Particle& p : found) {
    double least = 1;
    for (int k = 0; k < 9; ++k) {
      const int column = static_cast<int>(std::lround(p.at_px.x)) + k % 3 - 1;
      const int row = static_cast<int>(std::lround(p.at_px.y)) + k / 3 - 1;
      if (std::min(column, row) < 5 || column >= 395 || row >= 295) continue;
      least = std::min(least, distance(p.at_px, mask_centroid(greys, 400, column, row, 5)));
    }
    EXPECT_LT(least, 1e-6) << p.at_px.x << ' ' << p.at_px.y;
  }
}

TEST(Particles, FainterOfTwoTooNearIsDropped) {
  Rng rng(1, Purpose::test);
  const formats::Image one = test::draw_spots(100, 100, {{40, 50}}, 2, 60, 0, rng);
  formats::Image two = one;
  const formats::Image other = test::draw_spots(100, 100, {{49, 50}}, 2, 100, 0, rng);
  for (std::size_t i = 0; i < two.pixels.size(); ++i)
    two.pixels[i] = std::max(one.pixels[i], other.pixels[i]);
  ParticleFinder wide({.diameter = 9, .tone = ParticleTone::bright, .separation = 14});
  ASSERT_EQ(wide.find(two).size(), 1U);
  EXPECT_NEAR(wide.find(two)[0].at_px.x, 49, 0.5);
  ParticleFinder narrow({.diameter = 5, .tone = ParticleTone::bright, .separation = 6});
  EXPECT_EQ(narrow.find(two).size(), 2U);
}

TEST(Particles, NoneInBlankAndTinyPictures) {
  ParticleFinder finder({.diameter = 11});
  for (const int side : {1, 2, 5, 11, 12, 40}) {
    const formats::Image blank{side, side, 1, std::vector<std::uint8_t>(side * side, 77)};
    EXPECT_TRUE(finder.find(blank).empty()) << side;
  }
}

TEST(Particles, NothingIsNearerToTheBorderThanTheMask) {
  Rng rng(5, Purpose::test);
  const auto truth = std::vector<Vec2>{{2, 2}, {97, 50}, {50, 50}, {50, 1}};
  const formats::Image image = test::draw_spots(100, 100, truth, 2, 90, 2, rng);
  ParticleFinder finder({.diameter = 11, .tone = ParticleTone::bright, .min_mass = 100});
  for (const Particle& p : finder.find(image)) {
    EXPECT_GE(std::min(p.at_px.x, p.at_px.y), 3);
    EXPECT_LE(std::max(p.at_px.x, p.at_px.y), 96);
  }
}

TEST(Particles, SamePictureSameBits) {
  Rng rng(8, Purpose::test);
  const auto truth = test::scattered(300, 200, 20, rng);
  const formats::Image image = test::draw_spots(300, 200, truth, 2, 70, 6, rng);
  ParticleFinder used({.diameter = 11, .tone = ParticleTone::bright});
  used.find(test::draw_spots(500, 100, {{50, 50}}, 2, 70, 6, rng));
  const std::vector<Particle> again = used.find(image);
  ParticleFinder fresh({.diameter = 11, .tone = ParticleTone::bright});
  const auto& once = fresh.find(image);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].at_px, again[i].at_px);
    EXPECT_EQ(once[i].mass, again[i].mass);
  }
}

TEST(Particles, NoiseAsWideAsAParticleIsRefused) {
  EXPECT_THROW(ParticleFinder({.diameter = 5, .noise = 5}), InputError);
}

/// A picture of random greys.
formats::Image random_picture(int width, int height, Rng& rng) {
  formats::Image image{width, height, 1, {}};
  for (int i = 0; i < width * height; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(rng.below(256)));
  return image;
}

TEST(RoundWindow, SumsAreThoseOfEachPixel) {
  Rng rng(5, Purpose::test);
  for (const int radius : {0, 1, 5, 15, 16, 40}) {
    const int side = 2 * radius + 1 + RoundWindow::read_beyond;
    const formats::Image image = random_picture(side, 2 * radius + 2, rng);
    RoundWindow::Moments expected;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx) {
        if (dx * dx + dy * dy > radius * radius) continue;
        const int value = image.pixels[image.index(radius + dx, radius + dy)];
        expected.mass += value;
        expected.along_x += value * dx;
        expected.along_y += value * dy;
      }
    const auto seen =
        RoundWindow(radius).moments(image.pixels.data() + image.index(radius, radius), side);
    EXPECT_EQ(seen.mass, expected.mass) << radius;
    EXPECT_EQ(seen.along_x, expected.along_x) << radius;
    EXPECT_EQ(seen.along_y, expected.along_y) << radius;
  }
}

// By the definition, pixel by pixel; the Gaussian within rounding, the ground in whole greys.
TEST(BandPass, IsSmoothMinusGround) {
  Rng rng(6, Purpose::test);
  for (const int box : {3, 11, 31}) {
    const formats::Image image = random_picture(57, 38, rng);
    const auto grey = [&](int x, int y) {
      return static_cast<int>(image.pixels[image.index(std::clamp(x, 0, image.width - 1),
                                                       std::clamp(y, 0, image.height - 1))]);
    };
    BandPass pass({.noise_px = 1, .box_px = box, .min_foreground = 1, .dark_rises = false});
    const std::vector<float>& rise = pass.filter(image);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        double smooth = 0;
        double weights = 0;
        for (int dy = -4; dy <= 4; ++dy)
          for (int dx = -4; dx <= 4; ++dx) {
            const double weight = std::exp(-0.5 * (dx * dx + dy * dy));
            smooth += weight * grey(x + dx, y + dy);
            weights += weight;
          }
        int ground = 0;
        for (int dx = -(box / 2); dx <= box / 2; ++dx) {
          int column = 0;
          for (int dy = -(box / 2); dy <= box / 2; ++dy) column += grey(x + dx, y + dy);
          ground += column / box;
        }
        const double expected = smooth / weights - ground / box;
        if (std::abs(expected - 1) < 1e-3) continue;  // either side of the least difference
        ASSERT_NEAR(rise[image.index(x, y)], expected < 1 ? 0 : expected, 1e-3) << x << ' ' << y;
      }
  }
}

TEST(HighestAround, IsThatOfEachWindow) {
  Rng rng(2, Purpose::test);
  for (int side = 1; side <= 20; ++side) {
    const int width = 1 + static_cast<int>(rng.below(30));
    const int height = 1 + static_cast<int>(rng.below(30));
    std::vector<std::uint8_t> in(width * height);
    for (auto& v : in) v = static_cast<std::uint8_t>(rng.below(256));
    const cv::Mat out = highest_around(cv::Mat(height, width, CV_8U, in.data()), side);
    const int before = (side - 1) / 2;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        int highest = 0;
        for (int v = std::max(0, y - before); v < std::min(height, y - before + side); ++v)
          for (int u = std::max(0, x - before); u < std::min(width, x - before + side); ++u)
            highest = std::max<int>(highest, in[v * width + u]);
        ASSERT_EQ(out.at<std::uint8_t>(y, x), highest) << side << " at " << x << ", " << y;
      }
  }
}

TEST(RingFit, FindsCentreAndRadius) {
  Rng rng(4, Purpose::test);
  for (int k = 0; k < 20; ++k) {
    const double x = rng.uniform(29, 31);
    const Vec2 centre{x, rng.uniform(29, 31)};
    const double radius = rng.uniform(7, 10);
    formats::Image image{60, 60, 1, {}};
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 60; ++column) {
        const double off = distance(Vec2(column, row), centre) - radius;
        const double grey = 150 - 80 * std::exp(-0.5 * off * off / 2.25) + 2 * rng.normal();
        image.pixels.push_back(static_cast<std::uint8_t>(grey));
      }
    const auto ring = fit_ring(image, {30, 30}, 8.5, true);
    ASSERT_TRUE(ring);
    EXPECT_LT(distance(ring->centre_px, centre), 0.1);
    EXPECT_NEAR(ring->radius_px, radius, 0.1);
  }
  const formats::Image blank{60, 60, 1, std::vector<std::uint8_t>(3600, 90)};
  EXPECT_FALSE(fit_ring(blank, {30, 30}, 8, true));
}

}  // namespace
}  // namespace microswarm::vision
