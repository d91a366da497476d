// SPDX-License-Identifier: Apache-2.0
// Real files that nobody on this project made, skipped where they are not; and the samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/formats/ros.hpp"
#include "microswarm/formats/tracks.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

class Data : public testing::Test {
 protected:
  void SetUp() override {
    if (folder_.empty()) GTEST_SKIP() << "no folder MICROSWARM_DATA";
  }
  std::filesystem::path folder_ = test::data_folder();
};

double share_set(const Mask& mask) {
  return static_cast<double>(std::count(mask.cells.begin(), mask.cells.end(), 1)) /
         static_cast<double>(mask.cells.size());
}

/// The map has that size, and every query runs between free cells.
void expect_queries(const std::filesystem::path& file, int width, int height, double last_optimum) {
  const Mask blocked = read_moving_ai(file);
  EXPECT_EQ(blocked.width, width) << file;
  EXPECT_EQ(blocked.height, height) << file;
  const std::vector<GridQuery> queries = read_scenarios(file.string() + ".scen");
  EXPECT_DOUBLE_EQ(queries.back().optimal_length, last_optimum) << file;
  for (const GridQuery& query : queries) {
    ASSERT_EQ(query.width, width);
    ASSERT_EQ(blocked.at(query.start.column, query.start.row), 0);
    ASSERT_EQ(blocked.at(query.goal.column, query.goal.row), 0);
  }
}

double median_speed(const Tracks& walkers) {
  std::vector<double> speeds;
  for (const auto& [id, samples] : walkers)
    for (std::size_t i = 1; i < samples.times.size(); ++i)
      speeds.push_back(distance(samples.points[i], samples.points[i - 1]) /
                       (samples.times[i] - samples.times[i - 1]));
  std::nth_element(speeds.begin(), speeds.begin() + speeds.size() / 2, speeds.end());
  return speeds[speeds.size() / 2];
}

TEST(Samples, MovingAiMapAndQueries) {
  expect_queries(test::sample_folder() / "blocks.map", 32, 24, 35.14213562);
}

TEST(Samples, RosMap) {
  const LoadedMap rooms = load_map(RosMap{.file = "rooms.yaml"}, test::sample_folder());
  EXPECT_NEAR(rooms.map->bounds().lo.x, -1e6, 1e-3);
  EXPECT_NEAR(rooms.map->bounds().width(), 40 * 0.05e6, 1e-3);
  EXPECT_NEAR(rooms.map->bounds().height(), 30 * 0.05e6, 1e-3);
  const auto is_free = [&](int column, int row) {  // rows count from the top
    const Vec2 p{-1e6 + 0.05e6 * (column + 0.5), -0.5e6 + 0.05e6 * (30 - row - 0.5)};
    return rooms.map->is_free(p, 0);
  };
  EXPECT_TRUE(is_free(10, 10));
  EXPECT_TRUE(is_free(20, 14)) << "the door";
  EXPECT_FALSE(is_free(20, 20));
  EXPECT_FALSE(is_free(36, 26)) << "seen by nobody";
}

TEST(Samples, VesselMaskOfOneBit) {
  const Image image = read_image(test::sample_folder() / "vessels" / "retina_mask.png");
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.channels, 1);
  const Mask vessels = threshold(image, 128, false);
  EXPECT_GT(share_set(vessels), 0.04);
  EXPECT_LT(share_set(vessels), 0.09);
  EXPECT_EQ(mask_walls(vessels, 1).size(), 1u);
}

TEST(Samples, WalkersComeAtTheirSpeed) {
  const Tracks walkers = read_ucy_obsmat(test::sample_folder() / "walkers.txt", 1);
  EXPECT_EQ(walkers.size(), 16u);
  EXPECT_NEAR(median_speed(walkers), 1.15, 0.1);
}

TEST_F(Data, MovingAiMapsAndQueries) {
  const struct {
    const char* name;
    int width;
    int height;
    double last_optimum;
  } maps[] = {{"32room_000", 512, 512, 760.938},   {"Berlin_0_256", 256, 256, 369.44574280},
              {"arena", 49, 49, 62.1543},          {"den312d", 65, 81, 125.971},
              {"maze512-32-0", 512, 512, 2306.94}, {"random512-10-0", 512, 512, 668.188}};
  for (const auto& known : maps)
    expect_queries(folder_ / "grid_maps" / (std::string(known.name) + ".map"), known.width,
                   known.height, known.last_optimum);
}

/// A ROS pair of the data under the name that its YAML file has for the picture.
LoadedMap load_pair(const std::filesystem::path& source, const std::string& name, double um_per_m) {
  const test::Folder folder;
  std::filesystem::copy(source / ("nav2_" + name + ".pgm"), folder / (name + ".pgm"));
  std::filesystem::copy(source / ("nav2_" + name + ".yaml"), folder / "map.yaml");
  return load_map(RosMap{.file = "map.yaml", .um_per_m = um_per_m}, folder / "");
}

TEST_F(Data, RosMaps) {
  const LoadedMap depot = load_pair(folder_ / "planning2d", "depot", 1e6);
  EXPECT_NEAR(depot.map->bounds().width(), 604 * 0.05e6, 1e-3);
  EXPECT_NEAR(depot.map->bounds().height(), 307 * 0.05e6, 1e-3);
  EXPECT_FALSE(depot.map->walls().empty());
  const LoadedMap sandbox = load_pair(folder_ / "planning2d", "tb3_sandbox", 1000);
  EXPECT_EQ(sandbox.map->bounds().lo, (Vec2{-10000, -10000}));
  EXPECT_NEAR(sandbox.map->bounds().hi.x, 9200, 1e-9);
}

TEST_F(Data, VesselMasksOfOneBit) {
  for (const char* eye : {"01L", "05R", "09L", "12R"}) {
    for (const char* observer : {"obs1", "obs2"}) {
      const std::string name = std::string("CHASE_") + eye + "_mask_" + observer + ".png";
      const Image image = read_image(folder_ / "vessels" / name);
      EXPECT_EQ(image.width, 999);
      EXPECT_EQ(image.height, 960);
      EXPECT_EQ(image.channels, 1);
      const Mask vessels = threshold(image, 128, false);
      EXPECT_GT(share_set(vessels), 0.05) << name;
      EXPECT_LT(share_set(vessels), 0.09) << name;
      const std::size_t pieces = mask_walls(vessels, 1).size();
      EXPECT_GE(pieces, 1u);
      EXPECT_LE(pieces, 9u) << name;
    }
  }
}

TEST_F(Data, OtherPictures) {
  const Image bmp = read_image(folder_ / "vessels" / "muVES_Test2D.bmp");
  EXPECT_EQ(bmp.width, 800);
  EXPECT_EQ(bmp.height, 800);
  EXPECT_NEAR(share_set(threshold(bmp, 255, false)), 312890.0 / 640000, 1e-9) << "white";
  const Image maze = read_image(folder_ / "planning2d" / "ompl_maze_normal.ppm");
  EXPECT_EQ(maze.width, 450);
  EXPECT_EQ(maze.height, 450);
  EXPECT_EQ(maze.channels, 3);
  const Image retina = read_image(folder_ / "vessels" / "HRF_09_h.jpg");
  EXPECT_EQ(retina.width, 3504);
  EXPECT_EQ(retina.height, 2336);
  const Image frame = read_image(folder_ / "video" / "bulk_water" / "bulk_water_000.png");
  EXPECT_EQ(frame.width, 640);
  EXPECT_EQ(frame.channels, 3) << "alpha is dropped";
}

TEST_F(Data, WalkersComeAtTheirSpeed) {
  const Tracks walkers = read_ucy_obsmat(folder_ / "moving_obstacles" / "ucy_zara01_obsmat.txt", 1);
  EXPECT_EQ(walkers.size(), 148u);
  EXPECT_NEAR(median_speed(walkers), 1.19, 0.03);
}

}  // namespace
}  // namespace microswarm::formats
