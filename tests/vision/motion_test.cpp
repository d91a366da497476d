// SPDX-License-Identifier: Apache-2.0
// Drift, mean squared displacements and sub-pixel bias of tracks whose motion is known.
#include "microswarm/vision/tracking/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/tracking/search_area.hpp"
#include "microswarm/vision/tracking/video_tracks.hpp"

namespace microswarm::vision {
namespace {

constexpr double pixel_um = 0.5;    // [µm/px]
constexpr double frame_time = 0.1;  // [s]

/// Robots that diffuse by `step` px a frame along each axis and drift by `drift` px.
std::vector<TrackRow> walk(int robots, int frames, double step, Vec2 drift, std::uint64_t seed) {
  Rng rng(seed, Purpose::test);
  std::vector<Vec2> at;
  for (int i = 0; i < robots; ++i) {
    const double x = rng.uniform(0, 300);
    at.push_back({x, rng.uniform(0, 300)});
  }
  std::vector<TrackRow> rows;
  for (int k = 0; k < frames; ++k)
    for (int i = 0; i < robots; ++i) {
      Vec2& p = at[static_cast<std::size_t>(i)];
      if (k > 0) {
        const double dx = step * rng.normal();
        p += Vec2{dx, step * rng.normal()} + drift;
      }
      rows.push_back({.frame = k,
                      .t = frame_time * k,
                      .id = i,
                      .position = pixel_um * Vec2{p.x, -p.y},
                      .at_px = p});
    }
  return rows;
}

TEST(Motion, MsdOfDiffusionIsFourDt) {
  const auto rows = walk(60, 100, 0.8, {}, 3);
  const double diffusion = 0.8 * 0.8 * pixel_um * pixel_um / (2 * frame_time);  // of each axis
  const auto msd = mean_squared_displacements(rows);
  ASSERT_EQ(msd.size(), 24U);
  int within = 0;
  for (const MsdRow& row : msd) {
    EXPECT_EQ(row.tracks, 60);
    EXPECT_EQ(row.displacements, 60 * (100 - row.lag));
    EXPECT_NEAR(row.t, frame_time * row.lag, 1e-9);
    ASSERT_TRUE(row.standard_error);
    within += std::abs(row.msd - 4 * diffusion * row.t) < 2 * *row.standard_error;
  }
  EXPECT_GE(within, 20);
  const auto law = fit_power_law(msd);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1, 0.05);
  EXPECT_NEAR(law->diffusion, diffusion, 0.1 * diffusion);
}

// The standard error is the spread of the mean between videos.
TEST(Motion, StandardErrorsAreThoseOfTheMean) {
  std::vector<double> means;
  double squared_error = 0;
  constexpr int videos = 200;
  for (int v = 0; v < videos; ++v) {
    const auto msd = mean_squared_displacements(walk(12, 40, 1, {}, 100 + v));
    means.push_back(msd[4].msd);
    squared_error += *msd[4].standard_error * *msd[4].standard_error / videos;
  }
  double mean = 0;
  for (const double m : means) mean += m / videos;
  double variance = 0;
  for (const double m : means) variance += (m - mean) * (m - mean) / (videos - 1);
  EXPECT_NEAR(std::sqrt(squared_error / variance), 1, 0.15);
}

TEST(Motion, ConstantVelocityHasTheExponentTwo) {
  const auto msd = mean_squared_displacements(walk(3, 50, 0, {1.5, -2}, 1));
  const auto law = fit_power_law(msd);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 2, 1e-9);
  EXPECT_NEAR(4 * law->diffusion, std::pow(2.5 * pixel_um / frame_time, 2), 1e-6);
  const auto motions = motion_of_each(walk(3, 50, 0, {1.5, -2}, 1));
  ASSERT_EQ(motions.size(), 3U);
  for (const MotionRow& m : motions) {
    EXPECT_EQ(m.frames, 50);
    EXPECT_NEAR(*m.speed, 2.5 * pixel_um / frame_time, 1e-9);
    EXPECT_NEAR(*m.straight, 1, 1e-9);
  }
}

TEST(Motion, UnevenPicturesDoNotMixLags) {
  constexpr double speed = 30;
  std::vector<TrackRow> rows;
  double t = 0;
  for (int k = 0; k < 200; ++k) {
    rows.push_back({.frame = k, .t = t, .id = 0, .position = {speed * t, 0}});
    t += k < 120 ? 0.04 : 0.25;
  }
  const auto msd = mean_squared_displacements(rows);
  ASSERT_GT(msd.size(), 100U);
  for (const MsdRow& row : msd) {
    EXPECT_NEAR(row.t, 0.04 * row.lag, 0.021);
    EXPECT_NEAR(row.msd / std::pow(speed * row.t, 2), 1, 0.02) << row.lag;
  }
}

TEST(Motion, VelocitiesAreBetweenThePicturesAround) {
  std::vector<TrackRow> rows;
  for (const double t : {0.0, 0.1, 0.4, 0.5})
    for (int id = 0; id < 2; ++id)
      rows.push_back({.frame = static_cast<int>(10 * t),
                      .t = t,
                      .id = id,
                      .position = {(id ? -7 : 7) * t, 3 * t}});
  rows.push_back({.frame = 5, .t = 0.5, .id = 9, .position = {4, 4}, .velocity = {1, 1}});
  take_velocities(rows);
  for (const TrackRow& row : rows) {
    EXPECT_NEAR(row.velocity.x, row.id == 9 ? 0 : row.id ? -7 : 7, 1e-9);
    EXPECT_NEAR(row.velocity.y, row.id == 9 ? 0 : 3, 1e-9);
  }
}

TEST(Motion, DriftIsTakenOut) {
  auto rows = walk(80, 60, 0.3, {0.7, -0.4}, 5);
  const auto drift = drift_of(rows);
  ASSERT_EQ(drift.size(), 60U);
  EXPECT_EQ(drift[0].drift, Vec2{});
  EXPECT_EQ(drift[1].robots, 80);
  EXPECT_NEAR(drift.back().drift.x, 59 * 0.7 * pixel_um, 0.3);
  EXPECT_NEAR(drift.back().drift.y, 59 * 0.4 * pixel_um, 0.3);  // y goes up
  subtract_drift(rows, drift, pixel_um);
  for (const DriftRow& row : drift_of(rows)) EXPECT_NEAR(norm(row.drift), 0, 1e-9);
  for (const TrackRow& row : rows)
    EXPECT_NEAR(distance(row.position, pixel_um * Vec2{row.at_px.x, -row.at_px.y}), 0, 1e-9);
  EXPECT_NEAR(fit_power_law(mean_squared_displacements(rows))->exponent, 1, 0.08);
}

TEST(Motion, ARobotThatIsGoneForAWhileIsNoDrift) {
  std::vector<TrackRow> rows{{.frame = 0, .t = 0, .id = 0},
                             {.frame = 3, .t = 0.3, .id = 0, .position = {9, 0}},
                             {.frame = 4, .t = 0.4, .id = 0, .position = {10, 0}}};
  const auto drift = drift_of(rows);
  ASSERT_EQ(drift.size(), 3U);
  EXPECT_EQ(drift[2].drift, (Vec2{1, 0}));
  const auto msd = mean_squared_displacements(rows);
  ASSERT_EQ(msd.size(), 1U);
  EXPECT_EQ(msd[0].msd, 1);
  EXPECT_FALSE(msd[0].standard_error);
  EXPECT_TRUE(mean_squared_displacements({}).empty());
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_TRUE(drift_of({}).empty());
}

TEST(Motion, PositionsThatClingToPixelsAreSeen) {
  auto rows = walk(30, 60, 1.5, {}, 7);
  EXPECT_FALSE(pixel_bias(rows).is_significant);
  EXPECT_NEAR(pixel_bias(rows).cling, 0, 0.1);
  for (TrackRow& row : rows)
    row.at_px = 0.5 * (row.at_px + Vec2{std::round(row.at_px.x), std::round(row.at_px.y)});
  EXPECT_TRUE(pixel_bias(rows).is_significant);
  EXPECT_GT(pixel_bias(rows).cling, 0.5);
  const auto still = walk(30, 60, 0.001, {}, 7);  // one place in a pixel each, many times
  EXPECT_EQ(pixel_bias(still).fractions_x.size(), 30U);
  EXPECT_FALSE(pixel_bias(still).is_significant);
}

formats::Image numbered(int width, int height) {
  formats::Image image{width, height, 1, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.push_back(static_cast<std::uint8_t>(i));
  return image;
}

TEST(SearchArea, IsCutOutWithItsSurroundings) {
  const formats::Image grey = numbered(40, 30);
  SearchArea all({}, {}, 5);
  EXPECT_EQ(&all.crop(grey), &grey);
  EXPECT_TRUE(all.contains({-3, 99}));
  SearchArea part(PictureRegion{10, 12, 8, 6}, {}, 3);
  const formats::Image& cut = part.crop(grey);
  EXPECT_EQ(part.offset(), (Vec2{7, 9}));
  EXPECT_EQ(cut.width, 14);
  EXPECT_EQ(cut.height, 12);
  EXPECT_EQ(cut.pixels[cut.index(2, 1)], grey.pixels[grey.index(9, 10)]);
  EXPECT_TRUE(part.contains({10, 12}));
  EXPECT_TRUE(part.contains({17.4, 17.4}));
  EXPECT_FALSE(part.contains({17.6, 14}));
  EXPECT_FALSE(part.contains({12, 11.4}));
  formats::Mask mask(40, 30);
  mask.at(20, 21) = 1;
  SearchArea one({}, mask, 100);
  EXPECT_EQ(one.crop(grey).pixels, grey.pixels);
  EXPECT_TRUE(one.contains({20.2, 20.8}));
  EXPECT_FALSE(one.contains({21, 21}));
  EXPECT_FALSE(one.contains({-50, 21}));
}

TEST(SearchArea, ThatDoesNotFitIsRefused) {
  const formats::Image grey = numbered(40, 30);
  EXPECT_THROW(SearchArea(PictureRegion{10, 12, 31, 6}, {}, 3).crop(grey), InputError);
  EXPECT_THROW(SearchArea(PictureRegion{0, 0, 40, 31}, {}, 3).crop(grey), InputError);
  EXPECT_THROW(SearchArea({}, formats::Mask(30, 40), 3).crop(grey), InputError);
  EXPECT_THROW(SearchArea({}, formats::Mask(40, 30), 3).crop(grey), InputError);
}

}  // namespace
}  // namespace microswarm::vision
