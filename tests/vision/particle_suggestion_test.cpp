// SPDX-License-Identifier: Apache-2.0
// Settings suggested for pictures, by the masses of what is found in them.
#include "microswarm/vision/tracking/particle_suggestion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/vision/camera/frames.hpp"
#include "tests/files.hpp"
#include "tests/vision/discs.hpp"
#include "tests/vision/spots.hpp"

namespace microswarm::vision {
namespace {

/// Ten pictures of 48 spots, bright or dark by the sign of `height`.
std::vector<formats::Image> spotted(double spread, double height, double noise, int pitch = 50) {
  Rng rng(31, Purpose::test);
  const std::vector<Vec2> at = test::scattered(450, 350, pitch, rng);
  std::vector<formats::Image> pictures;
  for (int k = 0; k < 10; ++k)
    pictures.push_back(test::draw_spots(450, 350, at, spread, height, noise, rng));
  return pictures;
}

int found_in(const formats::Image& picture, const ParticleParams& params) {
  return static_cast<int>(ParticleFinder(params).find(picture).size());
}

std::vector<formats::Image> pictures_of(const std::filesystem::path& folder, VideoChannel channel) {
  std::vector<formats::Image> pictures;
  const auto source = open_frames(folder);
  for (VideoFrame frame; source->next(frame);)
    take_channel(frame.picture, channel, pictures.emplace_back());
  return pictures;
}

TEST(ParticleSuggestion, AMassBetweenNoiseAndRobots) {
  for (const double height : {-60.0, 60.0})
    for (const double noise : {1.5, 6.0}) {
      const auto pictures = spotted(2.2, height, noise);
      const ParticleParams given{.tone = height < 0 ? ParticleTone::dark : ParticleTone::bright};
      EXPECT_GT(found_in(pictures[0], given), 2 * 48);
      const ParticleSuggestion s = suggest_particles(pictures, given);
      ASSERT_TRUE(s.kinds.gap) << height << " " << noise;
      EXPECT_EQ(s.params.tone, given.tone);
      EXPECT_EQ(s.params.diameter, 11);
      for (const formats::Image& picture : pictures) EXPECT_EQ(found_in(picture, s.params), 48);
    }
}

TEST(ParticleSuggestion, TheOtherToneAndAnotherDiameter) {
  const ParticleSuggestion tone = suggest_particles(spotted(2.2, 60, 1.5), {});
  EXPECT_EQ(tone.params.tone, ParticleTone::bright);
  EXPECT_NEAR(tone.heavier_than(tone.params.min_mass), 48, 0.01);
  const auto large = spotted(7, -60, 3, 100);
  const ParticleSuggestion size = suggest_particles(large, {});
  EXPECT_TRUE(size.knows_diameter);
  EXPECT_GT(size.params.diameter, 25);
  EXPECT_LT(size.params.diameter, 45);
  EXPECT_EQ(found_in(large[0], size.params), 3 * 2);
}

TEST(ParticleSuggestion, FlatDiscsOfAnySizeAreFoundWithIt) {
  for (const double contrast : {-90.0, 70.0})
    for (const double noise : {0.0, 2.0, 8.0})
      for (const int radius : {4, 6, 8, 12, 15, 22, 30, 45, 70, 100}) {
        Rng rng(5, Purpose::test);
        std::vector<formats::Image> pictures;
        for (int k = 0; k < 3; ++k)
          pictures.push_back(test::two_discs(radius, contrast, noise, rng).picture);
        const ParticleSuggestion s = suggest_particles(pictures, {});
        const auto what = testing::Message()
                          << radius << " px, " << contrast << ", noise " << noise;
        EXPECT_EQ(s.params.tone, contrast < 0 ? ParticleTone::dark : ParticleTone::bright) << what;
        EXPECT_TRUE(s.knows_diameter) << what;
        EXPECT_GE(s.params.diameter, 2 * radius) << what;
        EXPECT_LE(s.params.diameter, 3 * radius) << what;
        for (const formats::Image& picture : pictures)
          EXPECT_EQ(found_in(picture, s.params), 2) << what;
      }
}

TEST(ParticleSuggestion, OnePictureOfTwoLargeRobotsIsEnough) {
  Rng rng(8, Purpose::test);
  for (const int radius : {10, 35, 80}) {
    const std::vector<formats::Image> one{test::two_discs(radius, 80, 4, rng).picture};
    const ParticleSuggestion s = suggest_particles(one, {});
    EXPECT_NEAR(s.params.diameter, 2.3 * radius, 0.3 * radius);
    EXPECT_EQ(found_in(one[0], s.params), 2) << radius;
  }
}

TEST(ParticleSuggestion, SaysWhenThereIsNoGap) {
  const ParticleSuggestion none = suggest_particles(spotted(2, 0, 2), {.min_mass = 33});
  EXPECT_FALSE(none.kinds.gap);
  EXPECT_TRUE(none.kinds.has_noise);
  EXPECT_FALSE(none.knows_diameter);
  EXPECT_EQ(none.params.min_mass, 33);
  const ParticleSuggestion faint = suggest_particles(spotted(2.2, -9, 6), {});
  EXPECT_FALSE(faint.kinds.gap);
  EXPECT_TRUE(faint.kinds.has_noise);
  const ParticleSuggestion clean = suggest_particles(spotted(2.2, -60, 0), {});
  EXPECT_FALSE(clean.kinds.gap && clean.kinds.gap->min_mass() > 500);
  EXPECT_NEAR(clean.heavier_than(clean.params.min_mass), 48, 0.01);
}

TEST(ParticleSuggestion, PairsAreRobotsToo) {
  std::vector<double> masses;
  std::vector<double> other;
  Rng rng(5, Purpose::test);
  for (int i = 0; i < 300; ++i) masses.push_back(1000 * std::exp(0.1 * rng.normal()));
  for (int i = 0; i < 100; ++i) masses.push_back(2000 * std::exp(0.1 * rng.normal()));
  EXPECT_FALSE(mass_kinds(masses, other, 10).gap);
  for (int i = 0; i < 900; ++i) masses.push_back(90 * std::exp(0.3 * rng.normal()));
  for (int i = 0; i < 900; ++i) other.push_back(90 * std::exp(0.3 * rng.normal()));
  const MassKinds kinds = mass_kinds(masses, other, 10);
  ASSERT_TRUE(kinds.gap);
  EXPECT_GT(kinds.gap->min_mass(), 200);
  EXPECT_LT(kinds.gap->min_mass(), 750);
}

TEST(ParticleSuggestion, OutliersOfTheNoiseAreNoRobots) {
  std::vector<double> masses{260, 270, 280, 5000, 5100, 5200, 5300, 5400};
  std::vector<double> other;
  Rng rng(6, Purpose::test);
  for (int i = 0; i < 600; ++i) masses.push_back(100 * std::exp(0.12 * rng.normal()));
  for (int i = 0; i < 600; ++i) other.push_back(100 * std::exp(0.12 * rng.normal()));
  const MassKinds kinds = mass_kinds(masses, other, 1);
  ASSERT_TRUE(kinds.gap);
  EXPECT_GT(kinds.gap->min_mass(), 400);
  EXPECT_LT(kinds.gap->min_mass(), 4500);
}

TEST(ParticleSuggestion, AFewClumpsOfDirtAreNotTheRobots) {
  std::vector<double> masses{9000, 9100, 9300, 9500};
  std::vector<double> other;
  Rng rng(6, Purpose::test);
  for (int i = 0; i < 60; ++i) masses.push_back(500 * std::exp(0.1 * rng.normal()));
  EXPECT_FALSE(mass_kinds(masses, other, 1).gap);
  for (int i = 0; i < 600; ++i) masses.push_back(100 * std::exp(0.12 * rng.normal()));
  for (int i = 0; i < 600; ++i) other.push_back(100 * std::exp(0.12 * rng.normal()));
  const MassKinds kinds = mass_kinds(masses, other, 1);
  ASSERT_TRUE(kinds.gap);
  EXPECT_LT(kinds.gap->min_mass(), 400);
}

TEST(ParticleSuggestion, TheSampleOfBrightRobots) {
  const auto pictures = pictures_of(test::sample_folder() / "video", VideoChannel::grey);
  for (const ParticleTone tone : {ParticleTone::dark, ParticleTone::bright}) {
    const ParticleSuggestion s = suggest_particles(pictures, {.tone = tone});
    EXPECT_EQ(s.params.tone, ParticleTone::bright);
    EXPECT_EQ(s.heavier_than(s.params.min_mass), 6);
  }
}

TEST(ParticleSuggestion, NothingAtAllIsNoCrash) {
  EXPECT_FALSE(suggest_particles({}, {}).kinds.gap);
  const std::vector<formats::Image> flat{{60, 50, 1, std::vector<std::uint8_t>(3000, 7)}};
  EXPECT_FALSE(suggest_particles(flat, {}).kinds.gap);
  const std::vector<formats::Image> tiny{{1, 1, 1, {7}}};
  EXPECT_FALSE(suggest_particles(tiny, {}).kinds.gap);
}

TEST(RealVideos, SettingsAreSuggested) {
  const std::filesystem::path data = test::data_folder() / "video";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  const auto bulk = suggest_particles(pictures_of(data / "bulk_water", VideoChannel::green), {});
  EXPECT_FALSE(bulk.kinds.gap);
  EXPECT_EQ(bulk.params.min_mass, 20);
  EXPECT_EQ(bulk.params.diameter, 11);
  EXPECT_EQ(bulk.params.tone, ParticleTone::dark);
  for (const int diameter : {11, 17}) {
    const auto bright = suggest_particles(pictures_of(data / "brightfield", VideoChannel::grey),
                                          {.diameter = diameter});
    EXPECT_EQ(bright.params.tone, ParticleTone::bright);
    ASSERT_TRUE(bright.kinds.gap);
    EXPECT_EQ(bright.heavier_than(bright.params.min_mass), 5);
    std::printf("brightfield from diameter %d: diameter %d, min_mass %.0f\n", diameter,
                bright.params.diameter, bright.params.min_mass);
  }
}

}  // namespace
}  // namespace microswarm::vision
