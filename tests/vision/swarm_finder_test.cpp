// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/swarm_finder.hpp"
#include "microswarm/core/maths/angles.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm::vision {
namespace {

using test::DrawnFrame;
using test::DrawnSwarm;

int clumps_for(double radius) { return static_cast<int>(0.16 * radius * radius); }

/// A swarm of any size, place and shape, under light uneven by up to 40 %, with noise.
struct Scene {
  DrawnSwarm swarm;
  formats::Image picture;
};
Scene scene(std::uint32_t trial, double max_noise) {
  Rng rng(11, Purpose::test, trial);
  Scene s;
  s.swarm.radius = rng.uniform(15, 80);
  const double reach = 1.5 * s.swarm.radius + 4;
  const double x = rng.uniform(reach, test::frame_width - reach);
  s.swarm.centre = {x, rng.uniform(reach, test::frame_height - reach)};
  s.swarm.elongation = rng.uniform(1, 2);
  s.swarm.angle = rng.uniform(-pi / 2, pi / 2);
  s.swarm.clumps = clumps_for(s.swarm.radius);
  DrawnFrame frame(test::frame_width, test::frame_height);
  frame.swarm(s.swarm, rng);
  const double slope = rng.uniform(0, 0.4);
  const double heading = rng.uniform(-pi, pi);
  s.picture = frame.expose(rng.uniform(110, 170), slope, heading, rng.uniform(0, 0.2),
                           rng.uniform(0, max_noise), rng);
  return s;
}

void expect_finite(const Blob& b) {
  EXPECT_TRUE(is_finite(b.centre_px));
  for (const double v : {b.radius_px, b.semi_major_px, b.semi_minor_px, b.angle, b.contrast})
    EXPECT_TRUE(std::isfinite(v));
  EXPECT_GE(b.semi_major_px, b.semi_minor_px);
  EXPECT_GE(b.outline_px.size(), 3U);
  for (const Vec2 p : b.outline_px) {
    EXPECT_GE(std::min(p.x, p.y), -3);
    EXPECT_LE(p.x, test::frame_width + 3);
    EXPECT_LE(p.y, test::frame_height + 3);
  }
}

TEST(SwarmFinder, PlaceSizeAndShapeOfHundredsOfSwarms) {
  for (const double max_noise : {0.0, 10.0}) {
    std::vector<double> off;
    std::vector<double> radius_off;
    std::vector<double> radius_bias;
    std::vector<double> angle_off;
    std::vector<double> ms;
    int missed = 0;
    for (int trial = 0; trial < test::cases(max_noise > 0 ? 250 : 50); ++trial) {
      const Scene s = scene(trial, max_noise);
      const auto began = std::chrono::steady_clock::now();
      const SwarmSighting seen = find_swarm(s.picture);
      ms.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
              .count());
      if (seen.sight != SwarmSight::found) {
        ++missed;
        std::printf("trial %u: %s, R %.1f\n", trial, enum_name(seen.sight).data(), s.swarm.radius);
        continue;
      }
      const Blob& b = *seen.swarm;
      expect_finite(b);
      off.push_back(distance(b.centre_px, s.swarm.centre));
      radius_bias.push_back(b.radius_px - s.swarm.radius);
      radius_off.push_back(std::abs(b.radius_px - s.swarm.radius) / s.swarm.radius);
      if (s.swarm.elongation > 1.3)
        angle_off.push_back(std::abs(std::remainder(b.angle - s.swarm.angle, pi)) * 180 / pi);
    }
    std::printf(
        "noise to %.0f: %d missed; place off %.2f px median, %.2f p99, %.2f worst; radius off "
        "%.1f %% median, %.1f %% p99, bias median %.2f px; angle off %.1f deg median, %.1f p99; "
        "%.2f ms median\n",
        max_noise, missed, quantile(off, 0.5), quantile(off, 0.99), quantile(off, 1),
        100 * quantile(radius_off, 0.5), 100 * quantile(radius_off, 0.99),
        quantile(radius_bias, 0.5), quantile(angle_off, 0.5), quantile(angle_off, 0.99),
        quantile(ms, 0.5));
    EXPECT_EQ(missed, 0);
    EXPECT_LT(quantile(off, 0.5), 0.5);
    EXPECT_LT(quantile(off, 0.99), 1.5);
    EXPECT_LT(quantile(radius_off, 0.5), 0.03);
    EXPECT_LT(quantile(radius_off, 0.99), 0.15);
    EXPECT_LT(quantile(angle_off, 0.99), 8);
  }
}

/// A swarm in the middle of an evenly lit picture, and what is put beside it.
formats::Image lit(const DrawnFrame& frame, double noise = 3) {
  Rng rng(21, Purpose::test);
  return frame.expose(150, 0.2, 0.5, 0.1, noise, rng);
}
DrawnFrame with_swarm(Vec2 centre, double radius) {
  Rng rng(22, Purpose::test);
  DrawnFrame frame(test::frame_width, test::frame_height);
  frame.swarm({.centre = centre, .radius = radius, .clumps = clumps_for(radius)}, rng);
  return frame;
}

TEST(SwarmFinder, LightUnevenByFortyPercentAndMuchNoise) {
  for (const double noise : {0.0, 5.0, 10.0})
    for (int k = 0; k < 8; ++k) {
      Rng rng(5, Purpose::test, k);
      const formats::Image picture =
          with_swarm({400, 180}, 30).expose(140, 0.4, k * pi / 4, 0, noise, rng);
      const SwarmSighting seen = find_swarm(picture);
      ASSERT_EQ(seen.sight, SwarmSight::found) << noise << " " << k;
      EXPECT_LT(distance(seen.swarm->centre_px, Vec2{400, 180}), 1);
      EXPECT_NEAR(seen.swarm->radius_px, 30, 2);
      EXPECT_FALSE(seen.swarm->is_cut);
    }
}

TEST(SwarmFinder, TwoSwarmsAreSeveralAndTheOneSeenBeforeIsFollowed) {
  DrawnFrame frame = with_swarm({150, 200}, 30);
  Rng rng(7, Purpose::test);
  frame.swarm({.centre = {450, 300}, .radius = 25, .clumps = clumps_for(25)}, rng);
  const formats::Image picture = lit(frame);
  const SwarmSighting both = find_swarm(picture);
  EXPECT_EQ(both.sight, SwarmSight::several);
  EXPECT_FALSE(both.swarm);
  ASSERT_EQ(both.candidates.size(), 2U);
  EXPECT_GT(both.candidates[0].radius_px, both.candidates[1].radius_px);
  const SwarmSighting one = find_swarm(picture, {}, Vec2{455, 290});
  ASSERT_EQ(one.sight, SwarmSight::found);
  EXPECT_LT(distance(one.swarm->centre_px, Vec2{450, 300}), 1);
  const SwarmSighting gone = find_swarm(picture, {.jump = 60}, Vec2{300, 250});
  EXPECT_EQ(gone.sight, SwarmSight::far);
  const SwarmSighting wide = find_swarm(picture, {.jump = 400}, Vec2{300, 250});
  EXPECT_EQ(wide.sight, SwarmSight::several);
}

TEST(SwarmFinder, DirtIsNoRival) {
  DrawnFrame frame = with_swarm({150, 200}, 30);
  frame.disc({400, 300}, 4, 0.3);   // below the least radius
  frame.disc({500, 100}, 11, 0.3);  // of too small a share of the area
  EXPECT_EQ(find_swarm(lit(frame)).sight, SwarmSight::found);
}

TEST(SwarmFinder, PartlyOutsideOfThePictureIsCut) {
  for (const Vec2 centre : {Vec2{10, 240}, Vec2{630, 240}, Vec2{320, 5}, Vec2{320, 475}}) {
    const SwarmSighting seen = find_swarm(lit(with_swarm(centre, 40)));
    ASSERT_EQ(seen.sight, SwarmSight::found);
    expect_finite(*seen.swarm);
    EXPECT_TRUE(seen.swarm->is_cut);
    EXPECT_LT(distance(seen.swarm->centre_px, centre), 20);
    EXPECT_LT(seen.swarm->radius_px, 40);
  }
}

TEST(SwarmFinder, AtAWallWhatTheWallDoesNotHideIsSeen) {
  formats::Mask walls(test::frame_width, test::frame_height);
  for (int y = 0; y < test::frame_height; ++y)
    for (int x = 0; x < test::frame_width; ++x) walls.at(x, y) = x >= 400 && x < 440;
  for (const double x : {330.0, 360.0, 372.0, 385.0}) {
    DrawnFrame frame = with_swarm({x, 240}, 30);
    frame.box({399.5, -1}, {439.5, 480}, 0.3);
    const SwarmSighting seen = find_swarm(lit(frame), {}, std::nullopt, &walls);
    ASSERT_EQ(seen.sight, SwarmSight::found) << x;
    EXPECT_EQ(seen.swarm->is_cut, x > 365) << x;
    EXPECT_LT(distance(seen.swarm->centre_px, Vec2{x, 240}), x < 365 ? 1.5 : x < 380 ? 4 : 11) << x;
  }
  EXPECT_EQ(
      find_swarm(lit(DrawnFrame(test::frame_width, test::frame_height)), {}, std::nullopt, &walls)
          .sight,
      SwarmSight::none);
  const formats::Mask wrong(4, 3);
  EXPECT_EQ(test::error_of([&] {
              find_swarm(lit(DrawnFrame(test::frame_width, test::frame_height)), {}, std::nullopt,
                         &wrong);
            }),
            "walls: 4x3 pixels, the picture has 640x480");
}

TEST(SwarmFinder, TinySwarmsDownToTheLeastRadius) {
  for (const double radius : {9.0, 7.0, 5.0, 4.0}) {
    Rng rng(8, Purpose::test);
    DrawnFrame frame(test::frame_width, test::frame_height);
    frame.swarm({.centre = {300.25, 200.5}, .radius = radius, .clumps = 60, .clump_radius = 1},
                rng);
    SwarmFinderParams params;
    params.look.min_radius = 0.6 * radius;
    params.look.gap = 3;
    const SwarmSighting seen = find_swarm(lit(frame), params);
    ASSERT_EQ(seen.sight, SwarmSight::found) << radius;
    EXPECT_LT(distance(seen.swarm->centre_px, Vec2{300.25, 200.5}), 0.5);
    EXPECT_NEAR(seen.swarm->radius_px, radius, 2);
  }
}

TEST(SwarmFinder, NothingIsFoundWhereNothingIs) {
  const auto even = [](int w, int h, int channels, int grey) {
    return formats::Image{w, h, channels,
                          std::vector<std::uint8_t>(static_cast<std::size_t>(w) * h * channels,
                                                    static_cast<std::uint8_t>(grey))};
  };
  for (const ParticleTone tone : {ParticleTone::dark, ParticleTone::bright}) {
    SwarmFinderParams params;
    params.look.tone = tone;
    for (const int grey : {0, 1, 128, 254, 255})
      for (const int channels : {1, 3})
        EXPECT_EQ(
            find_swarm(even(test::frame_width, test::frame_height, channels, grey), params).sight,
            SwarmSight::none);
    for (const int side : {1, 2, 3, 7, 20})
      EXPECT_EQ(find_swarm(even(side, side, 1, 90), params).sight, SwarmSight::none);
    EXPECT_EQ(find_swarm({}, params).sight, SwarmSight::none);
    Rng rng(9, Purpose::test);
    for (int k = 0; k < 20; ++k)
      EXPECT_EQ(
          find_swarm(
              DrawnFrame(test::frame_width, test::frame_height).expose(150, 0.4, k, 0.2, 10, rng),
              params)
              .sight,
          SwarmSight::none);
  }
}

TEST(SwarmFinder, AnyPictureGivesFiniteBlobs) {
  for (int k = 0; k < 60; ++k) {
    Rng rng(10, Purpose::test, k);
    formats::Image image{
        1 + static_cast<int>(rng.below(90)), 1 + static_cast<int>(rng.below(90)), 1, {}};
    const auto levels = 1 + rng.below(4);
    for (int i = 0; i < image.width * image.height; ++i)
      image.pixels.push_back(static_cast<std::uint8_t>(rng.below(levels) * 255 / levels));
    SwarmFinderParams params;
    params.look = {.min_radius = rng.uniform(1, 6), .gap = rng.uniform(1, 8)};
    for (const Blob& b : find_swarm(image, params).candidates) expect_finite(b);
  }
}

TEST(SwarmFinder, AFrozenPictureGivesTheSameBits) {
  const Scene s = scene(3, 10);
  const SwarmSighting a = find_swarm(s.picture);
  const SwarmSighting b = find_swarm(s.picture);
  ASSERT_EQ(a.sight, SwarmSight::found);
  EXPECT_EQ(a.swarm->centre_px, b.swarm->centre_px);
  EXPECT_EQ(a.swarm->radius_px, b.swarm->radius_px);
  EXPECT_EQ(a.swarm->outline_px, b.swarm->outline_px);
}

TEST(SwarmFinder, BrightOnDarkIsAsDarkOnBright) {
  const Scene s = scene(4, 5);
  formats::Image inverse = s.picture;
  for (auto& g : inverse.pixels) g = static_cast<std::uint8_t>(255 - g);
  SwarmFinderParams bright;
  bright.look.tone = ParticleTone::bright;
  const SwarmSighting a = find_swarm(s.picture);
  const SwarmSighting b = find_swarm(inverse, bright);
  ASSERT_EQ(a.sight, SwarmSight::found);
  ASSERT_EQ(b.sight, SwarmSight::found);
  EXPECT_LT(distance(a.swarm->centre_px, b.swarm->centre_px), 0.1);
  EXPECT_NEAR(a.swarm->radius_px, b.swarm->radius_px, 0.1);
}

TEST(SwarmFinder, AMovedSwarmIsSeenMovedBetweenPixelsToo) {
  double worst = 0;
  const auto at = [](double dx) { return find_swarm(lit(with_swarm({300 + dx, 200}, 35), 2)); };
  const Vec2 from = at(0).swarm->centre_px;
  for (int k = 1; k <= 20; ++k) {
    const Vec2 moved = at(0.1 * k).swarm->centre_px - from;
    worst = std::max(worst, distance(moved, Vec2{0.1 * k, 0}));
  }
  std::printf("a swarm moved by tenths of a pixel: worst error of the way %.3f px\n", worst);
  EXPECT_LT(worst, 0.15);
}

}  // namespace
}  // namespace microswarm::vision
