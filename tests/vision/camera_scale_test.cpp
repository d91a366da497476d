// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/core/maths/angles.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/calibration/calibration_grid.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm::vision {
namespace {

CameraScale any_scale(Rng& rng, bool y_up) {
  CameraScale s{.um_per_px = rng.uniform(0.1, 20), .rotation = rng.uniform(-pi, pi), .y_up = y_up};
  const double x = rng.uniform(-300, 900);
  s.origin_px = {x, rng.uniform(-300, 900)};
  return s;
}

TEST(CameraScale, PictureAndWorldAreEachOthersInverse) {
  Rng rng(1, Purpose::test);
  for (int k = 0; k < 200; ++k) {
    const CameraScale s = any_scale(rng, k % 2 == 0);
    const double x = rng.uniform(0, 640);
    const Vec2 p{x, rng.uniform(0, 480)};
    EXPECT_LT(distance(s.to_picture(s.to_world(p)), p), 1e-9);
    EXPECT_LT(norm(s.to_world(s.origin_px)), 1e-9);
    const Vec2 q{rng.uniform(0, 640), p.y};
    EXPECT_NEAR(distance(s.to_world(p), s.to_world(q)), s.um_per_px * distance(p, q), 1e-7);
  }
}

TEST(CameraScale, YGoesUpOrDown) {
  const CameraScale up{.um_per_px = 2, .origin_px = {10, 20}};
  EXPECT_EQ(up.to_world({11, 19}), (Vec2{2, 2}));
  const CameraScale down{.um_per_px = 2, .y_up = false, .origin_px = {10, 20}};
  EXPECT_EQ(down.to_world({11, 19}), (Vec2{2, -2}));
  const CameraScale turned{.um_per_px = 1, .rotation = pi / 2};
  EXPECT_LT(distance(turned.to_world({1, 0}), {0, 1}), 1e-12);  // the picture's x is the world's y
}

TEST(CameraScale, UprightIsAsMapsAndTracksLie) {
  const CameraScale s = upright_scale(480, 0.35);
  for (const Vec2 p : {Vec2{0, 0}, Vec2{639, 479}, Vec2{12.25, 40.5}})
    EXPECT_LT(distance(s.to_world(p), place_in_world(p, 480, 0.35)), 1e-9);
}

TEST(CameraScale, FitFindsTheScaleThatMadeThePoints) {
  Rng rng(2, Purpose::test);
  for (int k = 0; k < 200; ++k) {
    const CameraScale truth = any_scale(rng, k % 2 == 0);
    std::vector<ScalePoint> points(2 + k % 9);
    for (ScalePoint& p : points) {
      const double x = rng.uniform(0, 640);
      p.at_px = {x, rng.uniform(0, 480)};
      p.position = truth.to_world(p.at_px);
    }
    const FittedScale fit = fit_scale(points, truth.y_up);
    EXPECT_NEAR(fit.scale.um_per_px, truth.um_per_px, 1e-9 * truth.um_per_px);
    EXPECT_NEAR(std::remainder(fit.scale.rotation - truth.rotation, 2 * pi), 0, 1e-9);
    EXPECT_LT(distance(fit.scale.origin_px, truth.origin_px), 1e-6);
    EXPECT_LT(fit.worst, 1e-6);
  }
}

TEST(CameraScale, ResidualsShowTheWrongFlip) {
  const CameraScale truth{.um_per_px = 3, .y_up = false};
  std::vector<ScalePoint> points;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{100, 0}, Vec2{0, 100}})
    points.push_back({p, truth.to_world(p)});
  EXPECT_LT(fit_scale(points, false).worst, 1e-9);
  EXPECT_GT(fit_scale(points, true).rms, 50);
}

TEST(CameraScale, TwoPointsAndTheirDistance) {
  const CameraScale s = scale_of_distance({100, 100}, {400, 500}, 1000, 480);
  EXPECT_DOUBLE_EQ(s.um_per_px, 2);
  EXPECT_LT(norm(s.to_world({-0.5, 479.5})), 1e-12);  // the lower left corner
  const CameraScale t = scale_of_distance({100, 100}, {400, 500}, 1000, 480, Vec2{320, 240});
  EXPECT_EQ(t.to_world({321, 239}), (Vec2{2, 2}));
  EXPECT_EQ(test::error_of([] {
              scale_of_distance({5, 5}, {5, 5}, 10, 480);
            }),
            "scale: the two points are one");
  EXPECT_TRUE(test::is_one_line_naming(test::error_of([] {
                                         scale_of_distance({5, 5}, {6, 5}, -1, 480);
                                       }),
                                       "distance_um", {"-1", "0"}));
  EXPECT_TRUE(test::is_one_line_naming(
      test::error_of([] { fit_scale(std::vector<ScalePoint>(3)); }), "scale", {"points"}));
}

TEST(CameraScale, YamlReadsBackTheSameBits) {
  Rng rng(4, Purpose::test);
  const CameraScale s = any_scale(rng, false);
  const auto back = read_yaml_text<CameraScale>(to_yaml(s), "rig.yaml");
  EXPECT_EQ(back.um_per_px, s.um_per_px);
  EXPECT_NEAR(back.rotation, s.rotation, 1e-15);
  EXPECT_EQ(back.origin_px, s.origin_px);
  EXPECT_FALSE(back.y_up);
}

/// A slide with a grid whose points are `truth` sees, drawn with noise.
formats::Image slide(const GridParams& grid, const CameraScale& truth, Rng& rng) {
  test::DrawnFrame frame(640, 480);
  const double pitch_px = grid.pitch / truth.um_per_px;
  if (grid.pattern == GridPattern::dots) {
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        frame.disc(truth.to_picture(grid.pitch * Vec2{1.0 * column, 1.0 * row}), 0.25 * pitch_px,
                   0.2);
  } else {
    frame.draw({320, 240}, 400, 0.15, [&](Vec2 q) {
      const Vec2 at = truth.to_world(q) / grid.pitch;
      const double beyond = std::max({-1 - at.x, at.x - grid.columns, -1 - at.y, at.y - grid.rows});
      const double to_x = std::abs(at.x - std::round(at.x));
      const double to_y = std::abs(at.y - std::round(at.y));
      const bool black = (static_cast<int>(std::floor(at.x) + std::floor(at.y)) & 1) != 0;
      const double inside = std::min(to_x, to_y);
      return pitch_px * std::max(beyond, black ? -inside : inside);
    });
  }
  return frame.expose(160, 0.3, 0.7, 0.1, 4, rng);
}

TEST(CalibrationGrid, DotsAndChessboardsAreFoundAtAnyAngle) {
  for (const GridPattern pattern : {GridPattern::dots, GridPattern::chessboard}) {
    double worst_scale = 0;
    double worst_point = 0;
    double worst_turn = 0;
    for (int k = 0; k < test::cases(30); ++k) {
      Rng rng(5, Purpose::test, k);
      GridParams grid{.pattern = pattern, .columns = 9, .rows = 6, .pitch = 100};
      if (k % 5 == 4) std::swap(grid.columns, grid.rows);
      const double pitch_px = rng.uniform(22, 32);
      CameraScale truth{.um_per_px = grid.pitch / pitch_px, .rotation = rng.uniform(-0.7, 0.7)};
      const Vec2 half = 0.5 * grid.pitch * Vec2{grid.columns - 1.0, grid.rows - 1.0};
      const double x = rng.uniform(300, 340);
      truth.origin_px += Vec2{x, rng.uniform(225, 255)} - truth.to_picture(half);
      const std::vector<ScalePoint> points = find_grid(slide(grid, truth, rng), grid);
      const FittedScale fit = fit_scale(points);
      worst_scale = std::max(worst_scale, std::abs(fit.scale.um_per_px / truth.um_per_px - 1));
      worst_turn = std::max(worst_turn, std::abs(fit.scale.rotation - truth.rotation));
      for (const ScalePoint& p : points)
        worst_point = std::max(worst_point, distance(p.at_px, truth.to_picture(p.position)));
    }
    std::printf("%s: scale off by %.4f %%, angle by %.3f deg, a point by %.3f px at most\n",
                enum_name(pattern).data(), 100 * worst_scale, worst_turn * 180 / pi, worst_point);
    EXPECT_LT(worst_scale, 1e-3);
    EXPECT_LT(worst_turn, 2e-3);
    EXPECT_LT(worst_point, 0.5);
  }
}

TEST(CalibrationGrid, AnotherGridOrNoneIsRefused) {
  Rng rng(6, Purpose::test);
  const GridParams nine{.columns = 9, .rows = 6, .pitch = 100};
  const CameraScale s{.um_per_px = 4, .origin_px = {200, 300}};
  const formats::Image picture = slide(nine, s, rng);
  const auto refusal = [&](const formats::Image& image, const GridParams& grid) {
    return test::error_of([&] { find_grid(image, grid); });
  };
  EXPECT_TRUE(test::is_one_line_naming(refusal(picture, {.columns = 8, .rows = 6}), "grid",
                                       {"54", "points"}));
  const formats::Image flat{64, 48, 1, std::vector<std::uint8_t>(64 * 48, 100)};
  EXPECT_EQ(refusal(flat, nine), "grid: none is seen, asked for is one of 9x6");
  EXPECT_EQ(refusal(flat, {.pattern = GridPattern::chessboard}),
            "grid: none is seen, asked for is one of 9x6");
  EXPECT_EQ(find_grid(picture, {.columns = 6, .rows = 9, .pitch = 100}).size(), 54U);  // it stands
}

}  // namespace
}  // namespace microswarm::vision
