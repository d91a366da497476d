// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene_finder.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "microswarm/core/error.hpp"
#include "microswarm/core/statistics.hpp"
#include "tests/files.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm {
namespace {

using test::DrawnFrame;
using test::DrawnSwarm;

constexpr int width = 640;
constexpr int height = 480;

TEST(SceneFinder, SwarmAndObstaclesOfTheSameToneAreToldApart) {
  std::vector<double> grain_of_swarms;
  std::vector<double> grain_of_discs;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    Rng rng(3, Purpose::test, trial);
    DrawnFrame frame(width, height);
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
    const Image picture = frame.expose(170, 0.3, rng.uniform(-3, 3), 0.1, rng.uniform(0, 8), rng);
    SceneParams params;
    params.swarm.min_grain = 4;
    const SeenScene scene = find_scene(picture, params);
    ASSERT_EQ(scene.swarm.sight, SwarmSight::found) << trial;
    EXPECT_LT(distance(scene.swarm.swarm->centre_px, swarm.centre), 1.5);
    ASSERT_EQ(scene.obstacles.size(), 2U) << trial;
    int discs = 0;
    for (const SeenObstacle& o : scene.obstacles) {
      discs += o.is_disc;
      if (o.is_disc) {
        EXPECT_LT(distance(o.blob.centre_px, disc), 0.5);
        EXPECT_NEAR(o.blob.radius_px, radius, 1);
      } else {
        EXPECT_LT(distance(o.blob.centre_px, at), 0.5);
        EXPECT_NEAR(o.blob.semi_major_px / o.blob.semi_minor_px, 1 / 0.6, 0.1);
      }
      grain_of_discs.push_back(o.blob.grain);
    }
    EXPECT_EQ(discs, 1) << trial;
    grain_of_swarms.push_back(scene.swarm.swarm->grain);
  }
  std::printf("grain: swarms at least %.1f, obstacles at most %.1f grey\n",
              quantile(grain_of_swarms, 0), quantile(grain_of_discs, 1));
}

}  // namespace
}  // namespace microswarm
