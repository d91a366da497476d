// SPDX-License-Identifier: Apache-2.0
// Flat discs of 4 to 100 px radius, as robots of hundreds of pixels look.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/tracking/particles.hpp"
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

}  // namespace
}  // namespace microswarm::vision
