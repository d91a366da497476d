// SPDX-License-Identifier: Apache-2.0
// Flat discs of 4 to 100 px radius, as robots of hundreds of pixels look.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/tracking/particles.hpp"
#include "microswarm/vision/tracking/robot_width.hpp"
#include "tests/vision/discs.hpp"

namespace microswarm::vision {
namespace {

constexpr std::array radii{4, 5, 7, 10, 15, 20, 30, 45, 70, 100};

ParticleParams params_of(double radius, double factor, double contrast) {
  return {.diameter = static_cast<int>(std::lround(factor * radius)) | 1,
          .tone = contrast < 0 ? ParticleTone::dark : ParticleTone::bright,
          .min_mass = 0.2 * std::abs(contrast) * radius * radius};
}

/// Distance of the nearest particle from each of the true places, summed.
double sum_of_errors(const std::vector<Vec2>& truth, const std::vector<Particle>& found) {
  double sum = 0;
  for (const Vec2 at : truth) {
    double least = 1e3;
    for (const Particle& p : found) least = std::min(least, distance(p.at_px, at));
    sum += least;
  }
  return sum;
}

TEST(LargeParticles, CentresOfFlatDiscsAreExactWhateverTheirSize) {
  for (const double factor : {2.3, 3.0})
    for (const double contrast : {-90.0, 70.0})
      for (const double noise : {0.0, 2.0, 5.0, 20.0})
        for (const int radius : radii) {
          if (noise > 5 && radius < 15) continue;  // it hides small ones
          Rng rng(17, Purpose::test);
          double sum = 0;
          int count = 0;
          ParticleFinder finder(params_of(radius, factor, contrast));
          for (int k = 0; k < 6; ++k) {
            const test::Discs discs = test::two_discs(radius, contrast, noise, rng);
            const auto& found = finder.find(discs.picture);
            EXPECT_EQ(found.size(), discs.at_px.size())
                << radius << " px, " << contrast << ", noise " << noise << ", " << factor;
            EXPECT_EQ(finder.unsettled(), 0);
            sum += sum_of_errors(discs.at_px, found);
            count += static_cast<int>(discs.at_px.size());
          }
          EXPECT_LE(sum / count, noise > 5     ? 0.12
                                 : radius == 4 ? 0.06
                                               : 0.05)
              << radius << " px, " << contrast << ", noise " << noise << ", " << factor;
        }
}

TEST(LargeParticles, ADiscThatFillsItsMaskDoesNotClingToPixels) {
  for (const int radius : {4, 5, 6, 9, 14, 30}) {
    ParticleFinder finder(params_of(radius, 2.05, -90));
    for (double shift = 0; shift < 1; shift += 0.125) {
      const int side = 4 * radius + 30;
      formats::Image picture = test::flat_picture(side, side, 170);
      const Vec2 at{0.5 * side + shift, 0.5 * side + 0.3};
      test::draw_disc(picture, at, radius, -90);
      const auto& found = finder.find(picture);
      ASSERT_EQ(found.size(), 1U) << radius;
      EXPECT_LT(distance(found[0].at_px, at), 0.12) << radius << ", " << shift;
    }
  }
}

TEST(LargeParticles, ALimitOfMovesIsTold) {
  Rng rng(4, Purpose::test);
  const test::Discs discs = test::two_discs(60, -90, 2, rng);
  ParticleParams params = params_of(60, 2.3, -90);
  params.max_moves = 3;
  ParticleFinder stopped(params);
  EXPECT_EQ(stopped.find(discs.picture).size(), 2U);
  EXPECT_EQ(stopped.unsettled(), 2);
  EXPECT_GT(sum_of_errors(discs.at_px, stopped.find(discs.picture)), 5);
  params.max_moves = 0;
  ParticleFinder free(params);
  free.find(discs.picture);
  EXPECT_EQ(free.unsettled(), 0);
}

TEST(LargeParticles, AnOverexposedDiscIsOneParticleAtItsCentre) {
  for (const int radius : radii) {
    formats::Image picture = test::flat_picture(6 * radius + 20, 6 * radius + 20, 40);
    const Vec2 at{3.0 * radius + 10.3, 3.0 * radius + 9.6};
    test::draw_disc(picture, at, radius, 215);
    ParticleFinder finder(params_of(radius, 3, 215));
    const auto& found = finder.find(picture);
    ASSERT_EQ(found.size(), 1U) << radius;
    EXPECT_LT(distance(found[0].at_px, at), 0.05) << radius;
  }
}

TEST(Peaks, APlateauIsThinnedToItsMiddle) {
  std::vector<Peak> peaks;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 7; ++column) peaks.push_back({column, row});
  thin_plateaus(peaks);
  EXPECT_EQ(peaks, (std::vector<Peak>{{3, 2}}));
  std::vector<Peak> small{{0, 0}, {9, 0}, {1, 1}, {1, 2}, {2, 3}, {9, 9}};
  const std::vector<Peak> before = small;
  thin_plateaus(small);  // four that touch at corners, and two alone
  EXPECT_EQ(small, before);
  std::vector<Peak> ring{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}};
  thin_plateaus(ring);
  EXPECT_EQ(ring.size(), 1U);
  std::vector<Peak> none;
  thin_plateaus(none);
  EXPECT_TRUE(none.empty());
}

/// Share of the particles of two discs that are found to be wider than `diameter`.
double share_wider(double radius, int diameter, double contrast, double noise, Rng& rng) {
  const test::Discs discs = test::two_discs(radius, contrast, noise, rng);
  ParticleParams params = params_of(radius, 2, contrast);
  params.min_mass = 300;
  params.diameter = diameter;
  ParticleFinder finder(params);
  const auto& found = finder.find(discs.picture);
  if (found.empty()) return -1;
  const std::vector<bool> wider =
      wider_than_mask(discs.picture, found, finder.radius_px(), params.tone);
  return static_cast<double>(std::count(wider.begin(), wider.end(), true)) /
         static_cast<double>(found.size());
}

TEST(LargeParticles, WiderOnesThanTheDiameterAreTold) {
  Rng rng(8, Purpose::test);
  for (const double noise : {0.0, 5.0})
    for (const double contrast : {-90.0, 70.0}) {
      for (const auto& [radius, diameter] : {std::pair{8, 11}, {15, 11}, {30, 11}, {30, 45}})
        EXPECT_GE(share_wider(radius, diameter, contrast, noise, rng), 0.3)
            << radius << " px in " << diameter << ", noise " << noise;
      for (const auto& [radius, diameter] :
           {std::pair{4, 11}, {5, 11}, {8, 19}, {15, 35}, {15, 45}, {30, 69}})
        EXPECT_EQ(share_wider(radius, diameter, contrast, noise, rng), 0)
            << radius << " px in " << diameter << ", noise " << noise;
    }
}

TEST(LargeParticles, NeighboursThatTouchAreNoWideParticles) {
  constexpr double radius = 10;
  formats::Image picture = test::flat_picture(140, 140, 170);
  std::vector<Vec2> at{{70.3, 69.6}};
  for (int k = 0; k < 6; ++k)
    at.push_back(at[0] + 21.0 * Vec2{std::cos(k * 1.0471976), std::sin(k * 1.0471976)});
  test::draw_discs(picture, at, radius, -90, 0, nullptr);
  std::vector<Particle> particles;
  for (const Vec2 place : at) particles.push_back({.at_px = place});
  EXPECT_EQ(wider_than_mask(picture, particles, 11, ParticleTone::dark),
            std::vector<bool>(at.size()));
}

TEST(LargeParticles, DiscsThatAreDroppedForANearerOneAreCounted) {
  ParticleParams params = params_of(20, 2.3, -90);
  for (const double gap : {0.5, 2.0, 5.0, 20.0}) {
    formats::Image picture = test::flat_picture(220, 120, 170);
    test::draw_discs(picture, {{60.3, 60.7}, {100.3 + gap, 60.7}}, 20, -90, 0, nullptr);
    ParticleFinder finder(params);
    const std::size_t found = finder.find(picture).size();
    EXPECT_EQ(static_cast<int>(found) + finder.crowded(), 2) << gap;
  }
}

}  // namespace
}  // namespace microswarm::vision
