// SPDX-License-Identifier: Apache-2.0
// Walls of maps in pictures of cameras that are not where their rigs say.
#include "microswarm/rig/watch/picture_registration.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "tests/rig/watched_scenes.hpp"

namespace microswarm::rig {
namespace {

using test::opened;
using test::watched_pairs;
using test::WatchedPair;

/// Where the walls are in the first picture of a simulated camera with these settings.
PictureFit seen(const WatchedPair& pair, const std::vector<std::string>& microscope,
                bool wide = true) {
  std::vector<std::string> settings;
  for (const std::string& setting : microscope) settings.push_back("camera.microscope." + setting);
  const RigExperiment on = opened(pair, settings);
  RigSimulator simulator(on.scenario(), on.experiment.world, on.rig);
  const PictureRegistration registration(*on.experiment.world.map, simulator.camera());
  return registration.fit(simulator.render(simulator.capture()), wide);
}

class Registrations : public testing::TestWithParam<WatchedPair> {
 protected:
  /// The walls of the deforming channel, which move, cover the border of its workspace in part.
  bool has_hidden_border() const { return GetParam().name == "deforming"; }
  double tolerance() const { return has_hidden_border() ? 2 : 0.5; }  // [px]
};

TEST_P(Registrations, WallsAreAtTheirPlacesUnderAnyUsualLight) {
  for (const char* setting : {"noise=3", "noise=8", "light_gradient=0.5", "wall_depth=0.08"}) {
    const PictureFit fit = seen(GetParam(), {setting});
    EXPECT_EQ(fit.unsure, "") << setting;
    EXPECT_LT(fit.shift_px, tolerance()) << setting;
  }
}

TEST_P(Registrations, AShiftIsMeasured) {
  const PictureFit few = seen(GetParam(), {"shift_px=[8, 0]"}, false);
  EXPECT_EQ(few.unsure, "");
  EXPECT_NEAR(few.shift_px, 8, tolerance());
  EXPECT_NEAR(few.middle_px.x, 8, tolerance());
}

TEST_P(Registrations, ALargeShiftIsFound) {
  if (has_hidden_border()) GTEST_SKIP() << "two sides of its border remain in the picture";
  const PictureFit many = seen(GetParam(), {"shift_px=[30, -26]"});
  EXPECT_EQ(many.unsure, "");
  EXPECT_NEAR(many.shift_px, 39.7, 1);
}

TEST_P(Registrations, ATurnedCameraIsToldByItsAngle) {
  for (const double turn : {5.0, -5.0}) {
    const PictureFit fit = seen(GetParam(), {"turn_deg=" + std::to_string(turn)});
    EXPECT_EQ(fit.unsure, "");
    EXPECT_NEAR(degrees(fit.rotation), turn, 0.15);
    EXPECT_NEAR(fit.magnification, 1, 0.004);
    EXPECT_GT(fit.shift_px, 20);
  }
}

TEST_P(Registrations, AScaleErrorIsTold) {
  for (const double error : {0.02, -0.02}) {
    const PictureFit fit = seen(GetParam(), {"scale_error=" + std::to_string(error)});
    EXPECT_EQ(fit.unsure, "");
    EXPECT_NEAR(fit.magnification, 1 + error, 0.004);
    EXPECT_NEAR(degrees(fit.rotation), 0, 0.1);
    EXPECT_GT(fit.shift_px, 6);
  }
}

// What it says would fit does fit.
TEST_P(Registrations, TheScaleThatItTellsFits) {
  const RigExperiment on =
      opened(GetParam(), {"camera.microscope.shift_px=[7, 5]", "camera.microscope.turn_deg=2",
                          "camera.microscope.scale_error=0.01"});
  RigSimulator simulator(on.scenario(), on.experiment.world, on.rig);
  const formats::Image picture = simulator.render(simulator.capture());
  CameraView view = simulator.camera();
  const Map& map = *on.experiment.world.map;
  view.scale = PictureRegistration(map, view).fit(picture, true).scale;
  EXPECT_LT(PictureRegistration(map, view).fit(picture, true).shift_px, tolerance());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Registrations, testing::ValuesIn(watched_pairs()),
                         [](const auto& pair) { return pair.param.name; });

formats::Image noise(int width, int height) {
  Rng rng(1, Purpose::test);
  formats::Image picture{width, height, 1, {}};
  for (int i = 0; i < width * height; ++i)
    picture.pixels.push_back(static_cast<std::uint8_t>(120 + 4 * rng.normal()));
  return picture;
}

TEST(PictureRegistration, SaysWhatItCannotTell) {
  const CameraView view{vision::upright_scale(300, 1), 400, 300};
  const Map open(Box{{-1000, -1000}, {2000, 2000}}, {});
  EXPECT_NE(PictureRegistration(open, view).fit(noise(400, 300), true).unsure.find("0 edges"),
            std::string::npos);
  const Map walled(Box{{0, 0}, {400, 300}},
                   {{{{100, 100}, {200, 100}, {200, 200}, {100, 200}}, {}}});
  EXPECT_NE(PictureRegistration(walled, view).fit(noise(400, 300), true).unsure.find("are found"),
            std::string::npos);
  const Map straight(Box{{-1000, 0}, {2000, 300}},
                     {{{{-1000, 0}, {2000, 0}, {2000, 100}, {-1000, 100}}, {}}});
  formats::Image channel = noise(400, 300);
  for (int row = 200; row < 300; ++row)
    for (int column = 0; column < 400; ++column) channel.pixels[channel.index(column, row)] -= 50;
  EXPECT_NE(PictureRegistration(straight, view).fit(channel, true).unsure.find("fix it to"),
            std::string::npos);
}

// A map without walls: a still of what is in the picture, apart from the swarm.
TEST(PictureRegistration, AStillStandsInForWalls) {
  const CameraView view{vision::upright_scale(300, 2), 400, 300};
  PictureRegistration registration(Map(Box{{-1000, -1000}, {2000, 2000}}, {}), view);
  const auto scene = [](int right, int swarm) {
    formats::Image picture = noise(400, 300);
    const auto square = [&](int x, int y, int side) {
      for (int row = y; row < y + side; ++row)
        for (int column = x; column < x + side; ++column)
          picture.pixels[picture.index(column, row)] -= 60;
    };
    for (const Vec2 dust : {Vec2{40, 50}, Vec2{300, 80}, Vec2{150, 230}, Vec2{330, 250}})
      square(static_cast<int>(dust.x) + right, static_cast<int>(dust.y), 30);
    square(swarm, 120, 40);
    return picture;
  };
  const std::vector<vision::Ring> moving{{{200, 140}, 40}};
  registration.keep_still(scene(0, 180), moving);
  const PictureFit same = registration.fit(scene(0, 210), true);
  EXPECT_EQ(same.unsure, "");
  EXPECT_FALSE(same.by_walls);
  EXPECT_LT(same.shift_px, 0.5);
  EXPECT_NEAR(registration.fit(scene(8, 210), true).shift_px, 8, 0.5);
  EXPECT_NE(registration.fit(noise(400, 300), true).unsure, "");
  registration.keep_still(noise(400, 300), moving);
  EXPECT_NE(registration.fit(noise(400, 300), true).unsure, "");
}

// Vessels that observers drew over photographs are walls of a map, the rest is real.
TEST(PictureRegistration, DrawnVesselsAreFoundInPhotographs) {
  const char* const data = std::getenv("MICROSWARM_DATA");
  if (!data) GTEST_SKIP() << "MICROSWARM_DATA names no folder";
  for (const std::string name : {"CHASE_01L", "CHASE_05R", "CHASE_09L", "CHASE_12R"}) {
    const std::filesystem::path folder = std::filesystem::path(data) / "vessels";
    const formats::Image colours = formats::read_photograph(folder / (name + ".jpg"));
    const formats::Image drawn =
        formats::to_grey(formats::read_image(folder / (name + "_mask_obs1.png")));
    const formats::Mask walls = formats::threshold(drawn, 128, true);
    const CameraView view{vision::upright_scale(colours.height, 2), colours.width, colours.height};
    const PictureRegistration registration(
        Map(formats::cell_bounds(walls, 2), formats::mask_walls(walls, 2)), view);
    for (const int shift : {0, 8, -30}) {
      formats::Image green{colours.width, colours.height, 1, {}};
      for (int row = 0; row < green.height; ++row)
        for (int column = 0; column < green.width; ++column)
          green.pixels.push_back(
              colours
                  .pixels[1 + colours.index(std::clamp(column - shift, 0, green.width - 1), row)]);
      const PictureFit fit = registration.fit(green, true);
      EXPECT_EQ(fit.unsure, "") << name;
      EXPECT_NEAR(fit.middle_px.x, shift, 0.6) << name;
      EXPECT_NEAR(fit.middle_px.y, 0, 0.6) << name;
      EXPECT_NEAR(fit.magnification, 1, 0.003) << name;
    }
  }
}

}  // namespace
}  // namespace microswarm::rig
