// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/video_recorder.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/files.hpp"
#include "tests/vision/noise.hpp"

namespace microswarm::vision {
namespace {

using test::noise;

TEST(RecordedVideo, LosesNothing) {
  for (const int channels : {1, 3})
    for (const char* name : {"video.mkv", "video.avi"}) {
      const test::Folder folder;
      VideoRecorder recorder(folder / name, 25);
      const auto input = recorder.input();
      recorder.begin(100);
      constexpr int count = 40;
      for (int i = 0; i < count; ++i) input(noise(i, 96, 64, channels), 100 + 0.04 * i);
      const RecordedVideo& made = recorder.finish();
      EXPECT_EQ(made.trouble, "");
      EXPECT_EQ(made.frames, count);
      EXPECT_EQ(made.dropped, 0);
      const auto video = open_frames(folder / name);
      VideoFrame frame;
      for (int i = 0; i < count; ++i) {
        ASSERT_TRUE(video->next(frame));
        const formats::Image sent = noise(i, 96, 64, channels).picture;
        formats::Image grey;
        take_channel(frame.picture, VideoChannel::red, grey);
        EXPECT_EQ(channels == 3 ? frame.picture.pixels : grey.pixels, sent.pixels) << name << i;
      }
      EXPECT_FALSE(video->next(frame));
      std::istringstream times(read_file(folder / "video.csv"));
      std::string line;
      std::getline(times, line);
      EXPECT_EQ(line, "frame,camera_frame,t_s");
      for (int i = 0; i < count; ++i) {
        std::getline(times, line);
        EXPECT_EQ(line, fmt::format("{},{},{:.6f}", i, i, 0.04 * i));
      }
      EXPECT_FALSE(std::getline(times, line));
    }
}

}  // namespace
}  // namespace microswarm::vision
