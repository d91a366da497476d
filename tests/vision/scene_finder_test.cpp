// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/scene_finder.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/scene/scene_overlay.hpp"
#include "microswarm/vision/scene/wall_finder.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm::vision {
namespace {

using test::DrawnFrame;
using test::DrawnSwarm;

TEST(SceneFinder, SwarmAndObstaclesOfTheSameToneAreToldApart) {
  std::vector<double> grain_of_swarms;
  std::vector<double> grain_of_discs;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    Rng rng(3, Purpose::test, trial);
    DrawnFrame frame(test::frame_width, test::frame_height);
    const DrawnSwarm swarm{.centre = {rng.uniform(80, 240), rng.uniform(80, 400)},
                           .radius = rng.uniform(18, 45),
                           .clumps = 300,
                           .clump_radius = 1.5,
                           .opacity = 0.65};
    frame.swarm(swarm, rng);
    const Vec2 disc{rng.uniform(340, 420), rng.uniform(80, 400)};
    const double radius = rng.uniform(12, 40);
    frame.disc(disc, radius, 0.65);
    const Vec2 at{rng.uniform(520, 560), rng.uniform(80, 400)};
    const Vec2 u = unit_vector(rng.uniform(0, 6)) * 40;
    const Vec2 v = perpendicular(u) * 0.6;
    const std::vector<Vec2> box{at - u - v, at + u - v, at + u + v, at - u + v};
    frame.polygon(box, 0.65);
    const formats::Image picture =
        frame.expose(170, 0.3, rng.uniform(-3, 3), 0.1, rng.uniform(0, 8), rng);
    const SeenScene scene = find_scene(picture);
    ASSERT_EQ(scene.swarm.sight, SwarmSight::found) << trial;
    EXPECT_LT(distance(scene.swarm.swarm->centre_px, swarm.centre), 1.5);
    ASSERT_EQ(scene.obstacles.size(), 2U) << trial;
    int discs = 0;
    for (const SeenObstacle& o : scene.obstacles) {
      discs += o.disc.has_value();
      if (o.disc) {
        EXPECT_LT(distance(o.blob.centre_px, disc), 0.5);
        EXPECT_NEAR(o.blob.radius_px, radius, 1);
      } else {
        EXPECT_LT(distance(o.blob.centre_px, at), 0.5);
        EXPECT_NEAR(o.blob.semi_major_px / o.blob.semi_minor_px, 1 / 0.6, 0.1);
      }
      grain_of_discs.push_back(o.blob.texture);
    }
    EXPECT_EQ(discs, 1) << trial;
    grain_of_swarms.push_back(scene.swarm.swarm->texture);
  }
  std::printf("grain: swarms at least %.1f, obstacles at most %.1f grey\n",
              quantile(grain_of_swarms, 0), quantile(grain_of_discs, 1));
}

TEST(SceneFinder, ASwarmThatTouchesAnObstacleOfItsToneIsStillSeenAndSoIsTheObstacle) {
  std::vector<double> swarm_off;
  std::vector<double> obstacle_off;
  int lost = 0;
  int discs = 0;
  int trials = 0;
  for (const double apart : {-6.0, 0.0, 3.0, 8.0})
    for (int k = 0; k < test::cases(20); ++k, ++trials) {
      Rng rng(17, Purpose::test, trials);
      DrawnFrame frame(test::frame_width, test::frame_height);
      const double radius = rng.uniform(15, 40);
      const DrawnSwarm swarm{.centre = {320, 240},
                             .radius = rng.uniform(25, 45),
                             .clumps = 300,
                             .clump_radius = 1.5,
                             .opacity = 0.65};
      const Vec2 disc =
          swarm.centre + (swarm.radius + radius + apart) * unit_vector(rng.uniform(-3, 3));
      frame.swarm(swarm, rng);
      frame.disc(disc, radius, 0.65);
      const SeenScene scene = find_scene(frame.expose(170, 0.3, k, 0.1, rng.uniform(0, 8), rng), {},
                                         {.at_px = swarm.centre});
      if (scene.swarm.sight != SwarmSight::found || scene.obstacles.size() != 1) {
        ++lost;
        continue;
      }
      swarm_off.push_back(distance(scene.swarm.swarm->centre_px, swarm.centre));
      const SeenObstacle& o = scene.obstacles[0];
      discs += o.disc.has_value();
      if (o.disc) obstacle_off.push_back(distance(o.disc->centre_px, disc));
    }
  std::printf(
      "touching: %d of %d lost; swarm off %.2f px median, %.2f worst, obstacle %.2f and %.2f, "
      "%d times seen as a disc\n",
      lost, trials, quantile(swarm_off, 0.5), quantile(swarm_off, 1), quantile(obstacle_off, 0.5),
      quantile(obstacle_off, 1), discs);
  EXPECT_GE(discs, trials * 3 / 4);
  EXPECT_LE(lost, 1);
  EXPECT_LT(quantile(swarm_off, 0.9), 3);
  EXPECT_LT(quantile(obstacle_off, 0.9), 4);
}

/// Two channels that cross, with walls around them, and what moves in them.
struct Channels {
  DrawnFrame frame{test::frame_width, test::frame_height};
  formats::Mask walls{test::frame_width, test::frame_height};

  Channels() {
    for (const auto& [lo, hi] : {std::pair{Vec2{-0.5, -0.5}, Vec2{219.5, 159.5}},
                                 {{379.5, -0.5}, {639.5, 159.5}},
                                 {{-0.5, 319.5}, {219.5, 479.5}},
                                 {{379.5, 319.5}, {639.5, 479.5}}}) {
      frame.box(lo, hi, 0.6);
      for (int y = static_cast<int>(lo.y + 0.5); y <= hi.y; ++y)
        for (int x = static_cast<int>(lo.x + 0.5); x <= hi.x; ++x) walls.at(x, y) = 1;
    }
  }
};

/// Share of the pixels in which two masks agree.
double agreement(const formats::Mask& a, const formats::Mask& b) {
  double same = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i) same += a.cells[i] == b.cells[i];
  return same / static_cast<double>(a.cells.size());
}

TEST(Walls, AreFoundUnderUnevenLightThoughTheyAreHalfOfThePicture) {
  double worst = 1;
  for (int k = 0; k < 12; ++k) {
    Rng rng(12, Purpose::test, k);
    const Channels channels;
    const formats::Image still = channels.frame.expose(160, 0.4, k, 0.2, 6, rng);
    worst = std::min(worst, agreement(find_walls(still), channels.walls));
  }
  std::printf("walls: %.2f %% of the pixels are right at least\n", 100 * worst);
  EXPECT_GT(worst, 0.985);
}

TEST(Walls, NoneWhereThereAreNone) {
  Rng rng(13, Purpose::test);
  for (int k = 0; k < 5; ++k) {
    const formats::Mask walls = find_walls(
        DrawnFrame(test::frame_width, test::frame_height).expose(150, 0.4, k, 0.2, 8, rng));
    EXPECT_EQ(walls, formats::Mask(test::frame_width, test::frame_height));
  }
}

TEST(Walls, ComeIntoTheWorldWhereTheyAre) {
  const Channels channels;
  const double um_per_px = 2.5;
  const auto walls =
      walls_in_world(channels.walls, upright_scale(test::frame_height, um_per_px), 2);
  ASSERT_EQ(walls.size(), 4U);
  double sum = 0;
  for (const Polygon& p : walls) {
    EXPECT_GT(signed_area(p.outer), 0);
    sum += area(p);
  }
  EXPECT_NEAR(sum, um_per_px * um_per_px * (2 * 220 * 160 + 2 * 260 * 160), 0.01 * sum);
  CameraScale mirrored{.um_per_px = 1, .rotation = 0.3, .y_up = false};
  for (const Polygon& p : walls_in_world(channels.walls, mirrored, 1)) {
    EXPECT_GT(signed_area(p.outer), 0);
    const Box box = bounding_box(p);
    EXPECT_GT(box.hi.x, box.lo.x);
  }
}

TEST(Background, IsWhatStandsStill) {
  Rng rng(14, Purpose::test);
  const Channels channels;
  std::vector<formats::Image> pictures;
  for (int k = 0; k < 7; ++k) {
    Channels scene;
    scene.frame.swarm({.centre = {60.0 + 90 * k, 240}, .radius = 30}, rng);
    pictures.push_back(scene.frame.expose(160, 0.3, 0.4, 0.1, 4, rng));
  }
  EXPECT_GT(agreement(find_walls(still_background(pictures)), channels.walls), 0.985);
  EXPECT_EQ(test::error_of([] { still_background({}); }), "background: no pictures");
  pictures[3] = {2, 2, 1, {1, 2, 3, 4}};
  EXPECT_EQ(test::error_of([&] { still_background(pictures); }),
            "background: the pictures differ in size");
}

/// The picture of docs/explanation/vision.md: a swarm, discs and a polygon between walls. It is
/// written to the folder MICROSWARM_PICTURES, with the frame and what stands still in it.
TEST(SceneFinder, TheSceneOfTheDocsIsSeen) {
  Rng rng(15, Purpose::test);
  Channels scene;
  const formats::Image still = scene.frame.expose(165, 0.3, 0.6, 0.15, 5, rng);
  scene.frame.swarm({.centre = {120, 236},
                     .radius = 34,
                     .elongation = 1.5,
                     .angle = 0.4,
                     .clumps = 330,
                     .clump_radius = 1.7,
                     .opacity = 0.7},
                    rng);
  scene.frame.disc({178, 279}, 30, 0.55);  // it touches the swarm
  scene.frame.disc({300, 90}, 26, 0.55);
  scene.frame.disc({520, 262}, 20, 0.55);
  scene.frame.polygon({{270, 395}, {325, 372}, {338, 410}, {290, 436}}, 0.55);
  const formats::Image picture = scene.frame.expose(165, 0.3, 0.6, 0.15, 5, rng);
  SceneParams params;
  const formats::Mask walls = find_walls(still);
  const SeenScene seen = find_scene(picture, params, {}, &walls);
  ASSERT_EQ(seen.swarm.sight, SwarmSight::found);
  EXPECT_LT(distance(seen.swarm.swarm->centre_px, Vec2{120, 236}), 2);
  ASSERT_EQ(seen.obstacles.size(), 4U);
  int discs = 0;
  for (const SeenObstacle& o : seen.obstacles) discs += o.disc.has_value();
  EXPECT_EQ(discs, 3);
  const formats::Image drawn = draw_scene(picture, seen, &walls);
  if (const char* given = std::getenv("MICROSWARM_PICTURES")) {
    const std::filesystem::path folder = given;
    formats::write_png(folder / "still.png", still);
    formats::write_png(folder / "frame.png", picture);
    formats::write_png(folder / "seen.png", drawn);
  }
  EXPECT_EQ(drawn.channels, 3);
}

TEST(SceneFinder, ShapesComeIntoTheWorld) {
  Rng rng(16, Purpose::test);
  DrawnFrame frame(test::frame_width, test::frame_height);
  frame.disc({100, 100}, 20, 0.5);
  frame.polygon({{300, 300}, {380, 300}, {380, 340}, {300, 340}}, 0.5);
  SceneParams params;
  const SeenScene scene = find_scene(frame.expose(160, 0, 0, 0, 3, rng), params);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::none);
  ASSERT_EQ(scene.obstacles.size(), 2U);
  for (const bool y_up : {true, false}) {
    const CameraScale scale{.um_per_px = 3, .rotation = 0.5, .y_up = y_up, .origin_px = {50, 60}};
    const auto box = std::get<Polygon>(scene.obstacles[0].shape(scale));
    EXPECT_GT(signed_area(box.outer), 0);
    EXPECT_NEAR(area(box), 80 * 40 * 9, 0.05 * 80 * 40 * 9);
    const Disc disc = std::get<Disc>(scene.obstacles[1].shape(scale));
    EXPECT_LT(distance(disc.centre, scale.to_world({100, 100})), 1);
    EXPECT_NEAR(disc.radius, 60, 2);
  }
}

}  // namespace
}  // namespace microswarm::vision
