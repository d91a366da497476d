// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/calibration/lens_distortion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm::vision {
namespace {

constexpr int lens_width = 640;
constexpr int lens_height = 480;

/// Where a lens with this k1 shows what a straight one shows at `p`.
Vec2 bent(Vec2 p, double k1) {
  const Vec2 middle{0.5 * (lens_width - 1), 0.5 * (lens_height - 1)};
  const double half = 0.5 * std::hypot(lens_width, lens_height);
  Vec2 seen = p;
  for (int i = 0; i < 50; ++i) {
    const Vec2 way = seen - middle;
    seen = middle + (1 / (1 + k1 * squared_norm(way) / (half * half))) * (p - middle);
  }
  return seen;
}

/// A grid of 13x9 points that fills the picture, each off by a normal error.
std::vector<ScalePoint> grid(double k1, double noise_px, Rng& rng, bool y_up = true) {
  const CameraScale scale{.um_per_px = 2.5, .rotation = 0.1, .y_up = y_up, .origin_px = {70, 400}};
  std::vector<ScalePoint> points;
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 13; ++column) {
      const Vec2 at{50.0 + 44 * column, 40.0 + 48 * row};
      const double off = noise_px * rng.normal();
      points.push_back({bent(at, k1) + Vec2{off, noise_px * rng.normal()}, scale.to_world(at)});
    }
  return points;
}

TEST(LensDistortion, IsFoundAsItWas) {
  Rng rng(1, Purpose::test);
  for (const double k1 : {-0.2, -0.03, -0.004, 0.004, 0.03, 0.2})
    for (const bool y_up : {true, false}) {
      const auto found = fit_distortion(grid(k1, 0, rng, y_up), y_up, lens_width, lens_height);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->k1, k1, 1e-6);
      EXPECT_NEAR(found->shift_px, std::abs(k1) * 400, 1e-3);
      EXPECT_LT(found->rms, 1e-5);
      EXPECT_TRUE(found->is_found());
    }
}

TEST(LensDistortion, ItsDeviationIsThatOfTheErrors) {
  constexpr int grids = 200;
  double squares = 0, told = 0;
  int found_none = 0;
  for (int k = 0; k < grids; ++k) {
    Rng rng(2, Purpose::test, k);
    const auto found = fit_distortion(grid(0.02, 0.2, rng), true, lens_width, lens_height);
    ASSERT_TRUE(found);
    squares += std::pow(found->shift_px - 8, 2);
    told += found->deviation_px;
    Rng straight(3, Purpose::test, k);
    found_none +=
        !fit_distortion(grid(0, 0.2, straight), true, lens_width, lens_height)->is_found();
  }
  EXPECT_NEAR(std::sqrt(squares / grids) / (told / grids), 1, 0.15);
  EXPECT_GE(found_none, grids - 4);  // three deviations
}

TEST(LensDistortion, TheCornersErrorIsThatOfTheScale) {
  Rng rng(4, Purpose::test);
  const auto points = grid(0.05, 0, rng);
  const CameraScale fitted = fit_scale(points).scale;
  const CameraScale truth{.um_per_px = 2.5, .rotation = 0.1, .origin_px = {70, 400}};
  const Vec2 corner = bent({-24, -18}, 0.05);  // near the upper left one
  const double off = distance(fitted.to_world(corner), truth.to_world({-24, -18})) / 2.5;
  const auto found = fit_distortion(points, true, lens_width, lens_height);
  EXPECT_NEAR(found->error_px, off, 0.15 * off);
}

TEST(LensDistortion, TooFewPointsTellNothing) {
  Rng rng(5, Purpose::test);
  std::vector<ScalePoint> points = grid(0.05, 0, rng);
  points.resize(5);
  EXPECT_FALSE(fit_distortion(points, true, lens_width, lens_height));
  std::vector<ScalePoint> circle;  // a circle around the middle is one, bent or not
  for (int k = 0; k < 12; ++k) {
    const Vec2 way = 150 * unit_vector(2 * pi * k / 12);
    circle.push_back({Vec2{319.5, 239.5} + way, Vec2{way.x, -way.y}});
  }
  EXPECT_FALSE(fit_distortion(circle, true, lens_width, lens_height));
}

}  // namespace
}  // namespace microswarm::vision
