// SPDX-License-Identifier: Apache-2.0
// The search in windows, against the search of whole pictures.
#include "microswarm/vision/scene/scene_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/params/perception_params.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"
#include "microswarm/rig/simulation/microscope.hpp"

namespace microswarm::rig {
namespace {

struct DrawnVideo {
  std::shared_ptr<const Map> map = std::make_shared<const Map>(
      Box{{0, 0}, {1500, 900}},
      std::vector<Polygon>{{{{0, 0}, {1500, 0}, {1500, 120}, {0, 120}}, {}},
                           {{{700, 500}, {800, 500}, {800, 900}, {700, 900}}, {}}});
  MicroscopeParams optics{.um_per_px = 4};
  vision::SceneParams params{.swarm = {.look = {.min_contrast = 80, .gap = 4, .min_texture = 5}},
                             .obstacles = {.min_radius = 4, .gap = 2}};
  double speed = 50;  // of the obstacles [µm/s]

  Snapshot at(double t) const {
    return Snapshot(
        map, t,
        {{.shape = Disc{{300 + speed * t, 450}, 60}, .obstacle = 0},
         {.shape = Disc{{700 - speed * t, 500}, 80}, .obstacle = 1},
         {.shape = Disc{{1300, 170 + speed * t}, 70}, .obstacle = 2},
         {.shape = Polygon{{{1000, 500}, {1150, 550}, {1050, 700}}, {}}, .obstacle = 3}});
  }
  static SwarmPose swarm(double t) { return {{{200 + 60 * t, 250 + 25 * t}, 0}, 70}; }
};

void expect_same(const vision::SeenScene& quick, const vision::SeenScene& whole, double t) {
  ASSERT_EQ(quick.swarm.sight, whole.swarm.sight) << t;
  if (whole.swarm.swarm) {
    EXPECT_LT(distance(quick.swarm.swarm->centre_px, whole.swarm.swarm->centre_px), 0.1) << t;
    EXPECT_NEAR(quick.swarm.swarm->radius_px, whole.swarm.swarm->radius_px, 0.1) << t;
  }
  ASSERT_EQ(quick.obstacles.size(), whole.obstacles.size()) << t;
  for (const vision::SeenObstacle& expected : whole.obstacles) {
    // What covers a cut one is rounded to pixels.
    const double tolerance = expected.blob.is_cut ? 1 : 0.1;
    const bool same = std::any_of(
        quick.obstacles.begin(), quick.obstacles.end(), [&](const vision::SeenObstacle& found) {
          return distance(found.blob.centre_px, expected.blob.centre_px) < tolerance &&
                 std::abs(found.blob.radius_px - expected.blob.radius_px) < tolerance;
        });
    EXPECT_TRUE(same) << t << ": (" << expected.blob.centre_px.x << ", "
                      << expected.blob.centre_px.y << ")";
  }
}

void expect_same_video(const DrawnVideo& drawn, bool with_swarm = true) {
  Microscope microscope(drawn.optics, *drawn.map, 3, 0);
  const formats::Mask walls =
      walls_in_picture(*drawn.map, microscope.scale(), microscope.width(), microscope.height());
  vision::SceneWindows windows(walls);
  for (int i = 0; i < 40; ++i) {
    const double t = 0.25 * i;
    const auto swarm = with_swarm ? std::optional(DrawnVideo::swarm(t)) : std::nullopt;
    const formats::Image& picture = microscope.look(drawn.at(t), swarm, {});
    const Vec2 before = microscope.scale().to_picture(DrawnVideo::swarm(t).pose.position);
    expect_same(windows.find(picture, drawn.params, {.at_px = before}, {}),
                vision::find_scene(picture, drawn.params, {.at_px = before}, &walls), t);
  }
}

TEST(SceneWindows, ShowWhatTheWholePictureShows) { expect_same_video({}); }

TEST(SceneWindows, ShowItInNoiseAndSteepLight) {
  DrawnVideo drawn;
  drawn.optics.noise = 8;
  drawn.optics.light_gradient = 0.3;
  expect_same_video(drawn);
}

TEST(SceneWindows, ShowItWithCoarserWorkingPixels) {
  DrawnVideo drawn;
  drawn.params.obstacles = {.min_radius = 8, .gap = 4};
  drawn.optics.um_per_px = 2;
  expect_same_video(drawn);
}

TEST(SceneWindows, ShowThatThereIsNoSwarm) { expect_same_video({}, false); }

TEST(SceneWindows, AnEmptyOrEvenPictureHasNothing) {
  vision::SceneWindows windows{formats::Mask{}};
  for (const int side : {1, 3, 50}) {
    const formats::Image even{side, side, 1, std::vector<std::uint8_t>(side * side, 120)};
    const vision::SeenScene seen = windows.find(even, {}, {}, {});
    EXPECT_EQ(seen.swarm.sight, vision::SwarmSight::none);
    EXPECT_TRUE(seen.obstacles.empty());
  }
  EXPECT_EQ(windows.find({}, {}, {}, {}).swarm.sight, vision::SwarmSight::none);
}

}  // namespace
}  // namespace microswarm::rig
