// SPDX-License-Identifier: Apache-2.0
// The recorder's threads. Videos are read in video_recorder_test.cpp: FFmpeg's decoders have
// threads that the thread sanitizer does not know.
#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/vision/camera/video_recorder.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"
#include "tests/vision/noise.hpp"

namespace microswarm::vision {
namespace {

using test::noise;

TEST(VideoRecorder, WhatComesTooFastIsDroppedAndCountedNotWaitedFor) {
  const test::Folder folder;
  VideoRecorder recorder(folder / "video.mkv", 25);
  recorder.begin(0);
  const auto input = recorder.input();
  const VideoFrame large = noise(0, 1024, 1024, 3);
  double longest = 0;
  constexpr int count = 300;
  for (int i = 0; i < count; ++i) {
    const double began = steady_seconds();
    input(large, 0.001 * i);
    longest = std::max(longest, steady_seconds() - began);
  }
  const RecordedVideo& made = recorder.finish();
  EXPECT_EQ(made.trouble, "");
  EXPECT_GT(made.dropped, 0);
  EXPECT_EQ(made.frames + made.dropped, count);
  EXPECT_LT(longest, 0.5);
  std::printf("%d of %d frames of 3 MB dropped, the longest call %.1f ms\n", made.dropped, count,
              1e3 * longest);
  const std::string times = read_file(folder / "video.csv");
  EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), made.frames + 1);
}

TEST(VideoRecorder, FramesBeforeTheClockHaveNegativeTimes) {
  const test::Folder folder;
  VideoRecorder recorder(folder / "video.mkv", 25);
  const auto input = recorder.input();
  input(noise(0, 32, 32, 1), 9.9);
  input(noise(1, 32, 32, 1), 9.95);
  recorder.begin(10);
  input(noise(2, 32, 32, 1), 10.5);
  EXPECT_EQ(recorder.finish().frames, 3);
  EXPECT_EQ(read_file(folder / "video.csv"),
            "frame,camera_frame,t_s\n0,0,-0.100000\n1,1,-0.050000\n2,2,0.500000\n");
  input(noise(3, 32, 32, 1), 11);  // of no effect
  EXPECT_EQ(recorder.finish().frames, 3);
}

TEST(VideoRecorder, WithoutItsEndOnlyAPartIsThere) {
  const test::Folder folder;
  {
    VideoRecorder recorder(folder / "video.mkv", 25);
    recorder.begin(0);
    recorder.input()(noise(0, 32, 32, 1), 1);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "video.mkv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "video.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "video.part.mkv"));
  std::filesystem::remove(folder / "video.part.mkv");
  std::filesystem::remove(folder / "video.part.csv");
  { const VideoRecorder empty(folder / "video.mkv", 25); }
  EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
  VideoRecorder none(folder / "video.mkv", 25);
  none.begin(0);
  EXPECT_TRUE(test::is_one_line_naming(none.finish().trouble, (folder / "video.mkv").string(), {}));
}

TEST(VideoRecorder, WhatCannotBeWrittenIsRefusedAtOnce) {
  const test::Folder folder;
  const auto refusal = [&](const std::string& file) {
    return test::error_of([&] { VideoRecorder recorder(folder / file, 25); });
  };
  EXPECT_EQ(refusal("none/video.mkv"),
            (folder / "none/video.mkv").string() + ": cannot write: No such file or directory");
  std::filesystem::create_directories(folder / "video.part.csv/full");
  EXPECT_TRUE(test::is_one_line_naming(refusal("video.mkv"), (folder / "video.csv").string(), {}));
}

}  // namespace
}  // namespace microswarm::vision
