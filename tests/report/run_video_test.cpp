// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_video.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "tests/files.hpp"
#include "tests/runs.hpp"

namespace microswarm::report {
namespace {

namespace fs = std::filesystem;

class RunVideos : public testing::Test {
 protected:
  RunVideos() {
    const fs::path file = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios/first_flight.yaml";
    const experiment::Scene scene =
        experiment::load_scene(experiment::read_scenario(file), file.parent_path());
    record_ = test::record_of(scene);
  }

  test::Folder folder_;
  experiment::Record record_;
};

/// Columns [px] between which a picture has the swarm's colour.
std::pair<int, int> swarm_columns(const formats::Image& picture) {
  std::pair<int, int> columns{picture.width, -1};
  for (int row = 60; row < picture.height - 80; ++row)
    for (int column = 0; column < picture.width; ++column) {
      const auto* p = &picture.pixels[picture.index(column, row)];
      const bool is_green = p[1] > p[2] + 20;  // unlike the edges of the blue path
      if (!is_green || p[0] > 40 || std::abs(p[1] - 158) > 40 || std::abs(p[2] - 115) > 40)
        continue;
      columns = {std::min(columns.first, column), std::max(columns.second, column)};
    }
  return columns;
}

TEST_F(RunVideos, ShowTheRunFromItsBeginToItsEnd) {
  const fs::path file = folder_ / "run.mp4";
  const RunVideo video = write_run_video(record_, file, {.speed = 20, .rate = 10, .width = 641});
  ASSERT_EQ(video.file, file);
  EXPECT_FALSE(video.stopped);
  EXPECT_EQ(video.pictures, static_cast<int>(record_.frames.back().t / 2) + 1);
  const auto frames = vision::open_frames(file);
  vision::VideoFrame frame;
  std::vector<std::pair<int, int>> positions;
  while (frames->next(frame)) {
    EXPECT_EQ(frame.picture.width, 642);
    EXPECT_EQ(frame.picture.height % 2, 0);
    positions.push_back(swarm_columns(frame.picture));
  }
  ASSERT_EQ(positions.size(), static_cast<std::size_t>(video.pictures));
  const Box view = experiment::build_world(record_.scene).map->bounds();
  const double scale = (641 - 48) / view.width();
  for (const std::size_t k : {std::size_t{0}, positions.size() / 2}) {
    const double t = static_cast<double>(k) * 2;
    const auto at = std::ranges::lower_bound(record_.frames, t - 1e-9, {}, &experiment::Frame::t);
    const double middle = 0.5 * (positions[k].first + positions[k].second);
    EXPECT_NEAR(middle, 24 + (at->pose.position.x - view.lo.x) * scale, 3) << "picture " << k;
  }
}

TEST_F(RunVideos, AreStoppedWithWhatIsDone) {
  const std::atomic<bool> stopped = true;
  const RunVideo video = write_run_video(record_, folder_ / "run.mp4", {}, Stop(&stopped));
  EXPECT_TRUE(video.stopped);
  EXPECT_EQ(video.pictures, 0);
  EXPECT_TRUE(fs::is_empty(folder_ / ""));
}

TEST_F(RunVideos, ShowAPartOfTheRun) {
  const fs::path file = folder_ / "run.gif";
  const double end = record_.frames.back().t;
  const RunVideo video =
      write_run_video(record_, file, {.from = 4, .to = 9, .speed = 2, .rate = 10, .width = 320});
  ASSERT_EQ(video.file, file);
  EXPECT_EQ(video.pictures, 26);  // 5 s in steps of 0.2 s
  EXPECT_EQ(write_run_video(record_, file, {.from = end - 1, .rate = 10, .width = 320}).pictures,
            11);
  EXPECT_THROW(write_run_video(record_, file, {.from = end + 1}), InputError);
  EXPECT_THROW(write_run_video(record_, file, {.from = 9, .to = 4}), InputError);
}

TEST_F(RunVideos, OfTooManyPicturesAreRefusedBeforeTheFirst) {
  EXPECT_THROW(write_run_video(record_, folder_ / "run.mp4", {.speed = 1e-4}), InputError);
  EXPECT_THROW(write_run_video(experiment::Record{}, folder_ / "run.mp4"), InputError);
  EXPECT_THROW(write_run_video(record_, folder_ / "run.gif", {.rate = 60}), InputError);
  EXPECT_TRUE(fs::is_empty(folder_ / ""));
}

TEST(PictureRaster, HasTheColoursOfTheGroundBeneath) {
  Picture ground({{0, 0}, {100, 100}}, "", 101);
  ground.disc({{50, 50}, 20}, {1, 0, 0, 1});
  Picture picture({{0, 0}, {100, 100}}, "", 101);
  picture.ground(ground);
  picture.disc({{50, 50}, 5}, {0, 0, 1, 1});
  const formats::Image image = picture.raster();
  EXPECT_EQ(image.width % 2, 0);
  EXPECT_EQ(image.height % 2, 0);
  const auto colour = [&](int x, int y) {
    const auto* p = &image.pixels[image.index(24 + x, 24 + y)];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(colour(50, 50), (std::array{0, 0, 255}));
  EXPECT_EQ(colour(50, 37), (std::array{255, 0, 0}));
  EXPECT_EQ(colour(10, 10), (std::array{255, 255, 255}));
}

}  // namespace
}  // namespace microswarm::report
