// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/radar_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"
#include "tests/files.hpp"
#include "tests/runs.hpp"

namespace microswarm::report {
namespace {

constexpr double pixels = 400;
constexpr int margin = 24;  // px

class RadarView : public testing::Test {
 protected:
  RadarView()
      : record_(recorded()),
        world_(experiment::build_world(record_.scene)),
        view_(world_.map->bounds()) {}

  static experiment::Record recorded() {
    const std::filesystem::path file = MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/single.yaml";
    return test::record_of(
        experiment::load_scene(experiment::read_scenario(file), file.parent_path()));
  }

  /// Blue of the picture beside the centre of the obstacle in a frame, off its velocity's arrow.
  int blue_of_obstacle(std::size_t number) const {
    const test::Folder folder;
    Picture picture(view_, "", pixels);
    draw_radar_view(picture, record_, world_, number);
    picture.write(folder / "view.png");
    const formats::Image image = formats::read_image(folder / "view.png");
    const Snapshot then = world_.at(record_.frames[number].t);
    const auto& disc = std::get<Disc>(then.moving().bodies().front().shape);
    const Placement at =
        placement(record_.scene.scenario.obstacles.front().motion, record_.frames[number].t);
    const Vec2 p = disc.centre - (0.6 * disc.radius / norm(at.velocity)) * at.velocity;
    const double um_per_px = picture.um_per_px();
    const int column = margin + static_cast<int>((p.x - view_.lo.x) / um_per_px);
    const int row = margin + static_cast<int>((view_.hi.y - p.y) / um_per_px);
    return image.pixels[image.index(column, row) + 2];
  }

  experiment::Record record_;
  World world_;
  Box view_;
};

TEST_F(RadarView, WithoutALookTheCirclesAreThoseOfTheParameters) {
  const auto& params = std::get<navigation::RadarParams>(record_.scene.scenario.navigator);
  const RadarCircles wanted = navigation::make_circles(params, record_.frames[3].radius);
  EXPECT_EQ(radar_circles(record_, 3).detection, wanted.detection);
  navigation::RadarLook look;
  look.circles.detection = 7;
  EXPECT_EQ(radar_circles(record_, 3, look).detection, 7);
}

TEST_F(RadarView, AnObstacleIsLighterInsideTheDetectionCircle) {
  const auto& frames = record_.frames;
  const auto clearance = [](const experiment::Frame& a, const experiment::Frame& b) {
    return a.obstacle_clearance < b.obstacle_clearance;
  };
  const auto near = std::ranges::min_element(frames, clearance);
  const auto far = std::ranges::max_element(frames, clearance);
  ASSERT_LT(near->obstacle_clearance, radar_circles(record_, 0).detection);
  ASSERT_GT(far->obstacle_clearance, radar_circles(record_, 0).detection);
  EXPECT_GT(blue_of_obstacle(static_cast<std::size_t>(near - frames.begin())), 100);
  EXPECT_LT(blue_of_obstacle(static_cast<std::size_t>(far - frames.begin())), 100);
}

}  // namespace
}  // namespace microswarm::report
