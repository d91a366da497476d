// SPDX-License-Identifier: Apache-2.0
// Times of pictures: those in a video's container, in tables, in TIFFs and in names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/frame_times.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "microswarm/vision/camera/picture_names.hpp"
#include "microswarm/vision/camera/video_recorder.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"
#include "tests/files.hpp"
#include "tests/formats/tiff_writer.hpp"
#include "tests/vision/clips.hpp"
#include "tests/vision/seen.hpp"

namespace microswarm::vision {
namespace {

/// Ten pictures a second, then two.
const std::vector<double> uneven{0,   0.1, 0.2, 0.3, 0.4, 0.5, 0.6,
                                 1.1, 1.6, 2.1, 2.6, 3.1, 3.2, 3.3};

struct Container {
  const char* name;
  test::ClipForm form;
  double shift = 0;  ///< time of the first picture [s]
};

const std::vector<Container>& containers() {
  static const std::vector<Container> all{
      {"h264.mp4", {"libx264", AV_PIX_FMT_YUV420P, {1, 15360}}},
      {"b_frames.mp4", {"libx264", AV_PIX_FMT_YUV420P, {1, 15360}, 3}},
      {"late.mp4", {"libx264", AV_PIX_FMT_YUV420P, {1, 15360}, 3}, 0.75},
      {"mpeg4.mov", {"mpeg4", AV_PIX_FMT_YUV420P, {1, 1000}, 2}},
      {"h264.mkv", {"libx264", AV_PIX_FMT_YUV420P, {1, 1000}, 3}},
      {"ffv1.mkv", {"ffv1", AV_PIX_FMT_GRAY8, {1, 1000}}, 5},
      {"vp8.webm", {"libvpx", AV_PIX_FMT_YUV420P, {1, 1000}}},
      {"mpeg4.avi", {"mpeg4", AV_PIX_FMT_YUV420P, {1, 10}}},
      {"grey.gif", {"gif", AV_PIX_FMT_GRAY8, {1, 100}}}};
  return all;
}

TEST(VideoTimes, AreThoseOfTheContainer) {
  const test::Folder folder;
  int written = 0;
  for (const Container& c : containers()) {
    SCOPED_TRACE(c.name);
    std::vector<double> at = uneven;
    for (double& t : at) t += c.shift;
    if (!test::write_clip(folder / c.name, c.form, at)) continue;
    ++written;
    const Seen seen = see(folder / c.name);
    ASSERT_EQ(seen.times.size(), uneven.size());
    for (std::size_t k = 0; k < uneven.size(); ++k) {
      EXPECT_NEAR(seen.times[k], uneven[k], 1.1 * av_q2d(c.form.tick)) << k;
      const double share = static_cast<double>(seen.greys[k] - seen.greys[0]) /
                           (seen.greys.back() - seen.greys.front());
      EXPECT_NEAR(share * 13, static_cast<double>(k), 0.5) << k;  // the picture of this time
    }
    EXPECT_EQ(seen.why_ended, "");
    EXPECT_EQ(seen.count.value_or(14), 14);
    ASSERT_EQ(seen.notes.size(), 1U);
    EXPECT_EQ(seen.notes[0], (folder / c.name).string() +
                                 ": pictures are 0.1 to 0.5 s apart: the times are those in the "
                                 "file");
  }
  EXPECT_GE(written, 5);
}

TEST(VideoTimes, OfAnEvenVideoAreExactWhateverTheContainersTick) {
  const test::Folder folder;
  for (const Container& c : containers()) {
    SCOPED_TRACE(c.name);
    const double rate = std::string_view(c.name) == "mpeg4.avi" ? 10 : 20;
    std::vector<double> at;
    for (int k = 0; k < 20; ++k) at.push_back(c.shift + k / rate);
    if (!test::write_clip(folder / c.name, c.form, at)) continue;
    const Seen seen = see(folder / c.name);
    ASSERT_EQ(seen.times.size(), at.size());
    for (std::size_t k = 0; k < at.size(); ++k)
      EXPECT_NEAR(seen.times[k], static_cast<double>(k) / rate, 1e-9) << k;
    EXPECT_EQ(seen.notes, std::vector<std::string>{});
    const Seen faster = see(folder / c.name, {.rate = 100});
    EXPECT_EQ(faster.times[10], 0.1);
  }
}

TEST(VideoTimes, OfAGifAreItsDelaysAndNoOthersAreMovedToAGrid) {
  const test::Folder folder;
  std::vector<double> at{0};
  for (int k = 1; k < 20; ++k) at.push_back(at.back() + (k <= 10 ? 0.04 : 0.25));
  for (const Container& c : {Container{"v.gif", {"gif", AV_PIX_FMT_GRAY8, {1, 100}}},
                             Container{"v.mkv", {"ffv1", AV_PIX_FMT_GRAY8, {1, 1000}}}}) {
    if (!test::write_clip(folder / c.name, c.form, at)) continue;
    const Seen seen = see(folder / c.name);
    ASSERT_EQ(seen.times.size(), at.size());
    for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(seen.times[k], at[k], 1e-9) << k;
  }
}

/// Times that a clock makes of those in a file.
std::vector<double> clocked(ContainerClock clock, const std::vector<std::optional<double>>& told) {
  std::vector<double> times;
  times.reserve(told.size());
  for (const auto& t : told) times.push_back(clock.next(t));
  return times;
}

TEST(ContainerClock, KeepsAnEvenRowAsLongAsTicksCanTell) {
  const ContainerClock ms(10, 0.001);
  // Rounded to ticks, and from another zero.
  EXPECT_EQ(clocked(ms, {5.0, 5.101, 5.199, 5.3}), (std::vector<double>{0, 0.1, 0.2, 0.3}));
  // More than a tick off: times are those of the file from there on.
  const auto off = clocked(ms, {0.0, 0.11, 0.2005, 0.3005});
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(off[k], (std::vector<double>{0, 0.11, 0.2005, 0.3005})[k], 1e-12) << k;
  // So are they after a gap, though it is of whole intervals.
  const auto gap = clocked(ms, {0.0, 0.1, 0.3005, 0.4005});
  for (std::size_t k = 2; k < 4; ++k)
    EXPECT_NEAR(gap[k], (std::vector<double>{0, 0.1, 0.3005, 0.4005})[k], 1e-12) << k;
  // However coarse the ticks are, half an interval is no rounding.
  EXPECT_NEAR(clocked(ContainerClock(10, 0.05), {0.0, 0.1, 0.15})[2], 0.15, 1e-12);
}

TEST(ContainerClock, PlacesPicturesWithoutATimeAfterTheOneBefore) {
  ContainerClock clock(10, 0.001);
  const std::vector<double> expected{0, 0.1, 0.2, 0.3, 0.4};
  std::size_t k = 0;
  for (const std::optional<double> t :
       std::vector<std::optional<double>>{0.0, 0.1, 0.1, std::nullopt, 0.05})
    EXPECT_NEAR(clock.next(t), expected[k++], 1e-12) << k;
  ASSERT_EQ(clock.notes().size(), 1U);
  EXPECT_NE(clock.notes()[0].find("3 of 5 pictures have no time after the one before"),
            std::string::npos)
      << clock.notes()[0];
}

/// Ticks alone are not told as uneven times.
TEST(ContainerClock, RoundedTimesAreNotUneven) {
  ContainerClock drifting(30, 0.001);  // a mean rate that is rounded: 29.97
  for (int k = 0; k < 500; ++k) drifting.next(std::round(1000 * k / 29.97) / 1000);
  EXPECT_NEAR(drifting.last(), 499 / 29.97, 0.002);
  EXPECT_TRUE(drifting.notes().empty());
  ContainerClock uneven_by_more(30, 0.001);
  for (int k = 0; k < 500; ++k)
    uneven_by_more.next(std::round(1000 * k / 29.97) / 1000 + 0.004 * (k % 2));
  EXPECT_EQ(uneven_by_more.notes().size(), 1U);
}

TEST(VideoTimes, AnAnimatedPngIsAVideo) {
  const test::Folder folder;
  fs::create_directory(folder / "d");
  const std::vector<double> at{0, 0.04, 0.08, 0.33, 0.58};
  if (!test::write_clip(folder / "a.apng", {"apng", AV_PIX_FMT_GRAY8, {1, 100}}, at))
    GTEST_SKIP() << "without apng";
  fs::copy_file(folder / "a.apng", folder / "a.png");
  const Seen seen = see(folder / "a.png");
  ASSERT_EQ(seen.times.size(), at.size());
  for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(seen.times[k], at[k], 0.011) << k;
  for (const char* name : {"d/1.png", "d/2.png"}) fs::copy_file(folder / "a.apng", folder / name);
  EXPECT_NE(test::error_of([&] { see(folder / "d"); }).find("several pictures"), std::string::npos);
}

TEST(VideoTimes, PicturesThatAnEditListHidesAreNeitherShownNorCounted) {
  const test::Folder folder;
  std::vector<double> at;
  for (int k = 0; k < 20; ++k) at.push_back((k - 5) / 10.0);
  if (!test::write_clip(folder / "a.mp4", {"libx264", AV_PIX_FMT_YUV420P, {1, 15360}, 2}, at))
    GTEST_SKIP() << "without libx264";
  const Seen seen = see(folder / "a.mp4");
  ASSERT_GE(seen.times.size(), 15U);
  EXPECT_EQ(seen.count, static_cast<int>(seen.times.size()));
  EXPECT_EQ(seen.why_ended, "");
  for (std::size_t k = 0; k < seen.times.size(); ++k)
    EXPECT_NEAR(seen.times[k], static_cast<double>(k) / 10, 1e-9);
}

TEST(VideoTimes, ACutVideoSaysSo) {
  const test::Folder folder;
  std::vector<Container> all = containers();
  all.push_back({"a.apng", {"apng", AV_PIX_FMT_GRAY8, {1, 100}}});
  all.push_back({"a.y4m", {"wrapped_avframe", AV_PIX_FMT_YUV420P, {1, 10}}});
  const auto noise = [](int k, int x, int y) { return (x * 7919 + y * 104729 + k * 31) % 251; };
  for (const Container& c : all) {
    SCOPED_TRACE(c.name);
    if (std::string_view(c.name).ends_with(".mp4") || std::string_view(c.name).ends_with(".mov"))
      continue;  // it cannot be opened
    if (!test::write_clip(folder / c.name, c.form, uneven, noise)) continue;
    const std::string whole = read_file(folder / c.name);
    const auto file = folder.with(c.name, whole.substr(0, whole.size() / 2));
    const Seen seen = see(file);
    EXPECT_LT(seen.times.size(), uneven.size());
    EXPECT_TRUE(!seen.why_ended.empty() ||
                seen.count.value_or(0) > static_cast<int>(seen.times.size()));
    folder.with(c.name, whole);
    EXPECT_EQ(see(folder / c.name).why_ended, "");
  }
}

TEST(VideoTimes, ComeFromTheTableThatTheRecorderWrote) {
  const test::Folder folder;
  const fs::path file = folder / "camera.mkv";
  {
    VideoRecorder recorder(file, 30);
    recorder.begin(100);
    for (int k = 0; k < 8; ++k)
      recorder.input()(
          {.index = 3 * k, .t = 0, .picture = {8, 8, 1, std::vector<std::uint8_t>(64)}},
          100 + 0.1 * k * k - 0.05);
    ASSERT_EQ(recorder.finish().trouble, "");
  }
  const Seen seen = see(file);
  ASSERT_EQ(seen.times.size(), 8U);
  for (int k = 0; k < 8; ++k)
    EXPECT_NEAR(seen.times[static_cast<std::size_t>(k)], 0.1 * k * k - 0.05, 1e-6);
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("camera.csv, which was recorded with it"), std::string::npos);
  EXPECT_NEAR(see(file, {.rate = 10}).times[1], 0.1, 1e-12);
  // Another table of this name is left alone; one of ours that is damaged is told.
  folder.with("camera.csv", "frame,t_s\n0,5\n");
  EXPECT_NEAR(see(file).times[1], 1 / 30.0, 1e-9);
  folder.with("camera.csv", "frame,camera_frame,t_s\n0,0,2\n1,1,1\n");
  const Seen damaged = see(file);
  EXPECT_NEAR(damaged.times[1], 1 / 30.0, 1e-9);
  ASSERT_EQ(damaged.notes.size(), 1U);
  EXPECT_NE(damaged.notes[0].find("camera.csv:3: time 1 s is not after 2 s"), std::string::npos);
  folder.with("camera.csv", "frame,camera_frame,t_s\n0,0,2\n1,1,3\n");
  const Seen too_few = see(file);
  EXPECT_EQ(too_few.times, (std::vector<double>{2, 3}));
  EXPECT_NE(too_few.why_ended.find("camera.csv: 2 times, "), std::string::npos);
}

TEST(VideoTimes, ComeFromTheRecordersTableThatASpreadsheetSavedAgain) {
  const test::Folder folder;
  if (!test::write_clip(folder / "a.mkv", {"ffv1", AV_PIX_FMT_GRAY8}, {0, 0.1, 0.2}))
    GTEST_SKIP() << "without ffv1";
  for (const std::string text :
       {"frame,camera_frame,t_s\n0,0,5\n1,1,5.5\n2,2,7\n",
        "\"frame\";\"camera_frame\";\"t_s\"\r\n0;0;5\r\n1;1;5,5\r\n2;2;7\r\n",
        "\xEF\xBB\xBF"
        "frame\tcamera_frame\tt_s\n0\t0\t5\n1\t1\t5.5\n2\t2\t7\n"}) {
    folder.with("a.csv", text);
    EXPECT_EQ(see(folder / "a.mkv").times, (std::vector<double>{5, 5.5, 7})) << text;
  }
  folder.with("a.csv", "frame,t_s\n0,5\n1,5.5\n2,7\n");
  const Seen own = see(folder / "a.mkv");
  EXPECT_NEAR(own.times[1], 0.1, 1e-9);
  ASSERT_EQ(own.notes.size(), 1U);
  EXPECT_NE(own.notes[0].find("a.csv beside it are not used"), std::string::npos) << own.notes[0];
  for (const char* other : {"frame,id,t_s,x_um\n0,0,5,1\n", "a,b\n1,2\n", ""}) {
    folder.with("a.csv", other);
    EXPECT_EQ(see(folder / "a.mkv").notes, std::vector<std::string>{}) << other;
  }
}

TEST(VideoTimes, OfARecordingWithoutItsTableHaveTheRateOfItsFirstPictures) {
  const test::Folder folder;
  const fs::path file = folder / "camera.mkv";
  for (const int pictures : {1, 5, 40}) {
    {
      VideoRecorder recorder(file, 0);
      recorder.begin(100);
      for (int k = 0; k < pictures; ++k)
        recorder.input()({.index = k, .t = 0, .picture = {8, 8, 1, std::vector<std::uint8_t>(64)}},
                         100 + k / 15.0);
      ASSERT_EQ(recorder.finish().trouble, "");
      ASSERT_EQ(recorder.finish().frames, pictures);
    }
    fs::remove(folder / "camera.csv");
    const Seen seen = see(file);
    ASSERT_EQ(seen.times.size(), static_cast<std::size_t>(pictures));
    EXPECT_NEAR(seen.times.back(), (pictures - 1) / 15.0, 1e-3 * pictures);
  }
}

TEST(VideoTimes, GivenOnesFarFromTheFilesAreTold) {
  const test::Folder folder;
  if (!test::write_clip(folder / "a.mkv", {"ffv1", AV_PIX_FMT_GRAY8}, {0, 0.1, 0.2}))
    GTEST_SKIP() << "without ffv1";
  const Seen ms = see(folder / "a.mkv", {.times = folder.with("t.csv", "0\n100\n200\n")});
  EXPECT_EQ(ms.times, (std::vector<double>{0, 100, 200}));
  ASSERT_EQ(ms.notes.size(), 1U);
  EXPECT_NE(ms.notes[0].find("are 100 s apart, those in the file 0.1 s"), std::string::npos);
  EXPECT_EQ(see(folder / "a.mkv", {.times = folder.with("t.csv", "0\n0.11\n0.2\n")}).notes,
            std::vector<std::string>{});
}

TEST(VideoPixels, ThatAreNoSquaresAreStretched) {
  const test::Folder folder;
  for (const char* name : {"a.mp4", "a.mkv", "a.avi"})
    for (const AVRational aspect : {AVRational{2, 1}, AVRational{1, 2}, AVRational{1, 1}}) {
      test::ClipForm form{"mpeg4"};
      form.tick = {1, 10};
      form.aspect = aspect;
      if (!test::write_clip(folder / name, form, {0, 0.1, 0.2})) continue;
      const auto frames = open_frames(folder / name);
      VideoFrame frame;
      ASSERT_TRUE(frames->next(frame));
      const double ratio = av_q2d(aspect);
      EXPECT_EQ(frame.picture.width, ratio > 1 ? 2 * test::clip_width : test::clip_width) << name;
      EXPECT_EQ(frame.picture.height, ratio < 1 ? 2 * test::clip_height : test::clip_height)
          << name;
      ASSERT_EQ(frames->notes().size(), ratio == 1 ? 0U : 1U) << name;
      if (ratio != 1) {
        EXPECT_NE(frames->notes()[0].find("times as wide as high"), std::string::npos);
      }
    }
}

TEST(FrameTimes, OfATableAreTaken) {
  const test::Folder folder;
  fs::create_directory(folder / "v");
  write_pictures(folder, {"v/1.png", "v/2.png", "v/3.png"});
  for (const std::string text :
       {"10\n10.5\n12\n", "# a clock\n10\r\n10.5\r\n\r\n12", "\xEF\xBB\xBFt_s\n10\n10.5\n12\n",
        "frame,t_s,note\n0,10,a\n1,10.5,b\n2,12,c\n", "\"frame\";\"t_s\"\n0;10\n1;10.5\n2;12\n"})
    EXPECT_EQ(see(folder / "v", {.times = folder.with("t.csv", text)}).times,
              (std::vector<double>{10, 10.5, 12}))
        << text;
  EXPECT_NEAR(
      open_frames(folder / "v", {.times = folder.with("t.csv", "1\n2\n5\n")})->rate().value_or(0),
      0.5, 1e-12);
  for (const std::string text : {"1\n2\n", "1\n2\n3\n4\n"})
    EXPECT_NE(test::error_of([&] {
                see(folder / "v", {.times = folder.with("t.csv", text)});
              }).find("t.csv: " + std::to_string(text.size() / 2) + " times, there are 3 pictures"),
              std::string::npos);
}

TEST(FrameTimes, ThatAreNoneAreRefusedWithTheirLine) {
  const auto error = [](std::string_view text) {
    return test::error_of([&] { parse_frame_times(text, "t.csv"); });
  };
  EXPECT_EQ(error("1\n1\n"), "t.csv:2: time 1 s is not after 1 s");
  EXPECT_EQ(error("1\nx\n"), "t.csv:2: 'x' is no time in seconds");
  EXPECT_EQ(error("\xFF\xFE"
                  "1"),
            "t.csv: is UTF-16: save it as UTF-8");
  EXPECT_TRUE(error("frame,time_ms\n").starts_with("t.csv:1: no column 't_s'"));
  EXPECT_TRUE(error("0,1\n").starts_with("t.csv:1: 2 columns without names"));
  EXPECT_EQ(error("frame,t_s\n0\n"), "t.csv:2: no time in this line");
  EXPECT_EQ(error("1e13\n"), "t.csv:1: time 1e13 s, at most 1e12");
  EXPECT_EQ(error(" \n# 1\n"), "t.csv: no times: seconds expected, one a line");
}

TEST(FrameTimes, OfAVideoMustBeEnough) {
  const test::Folder folder;
  if (!test::write_clip(folder / "a.mkv", {"ffv1", AV_PIX_FMT_GRAY8}, uneven))
    GTEST_SKIP() << "without ffv1";
  const FrameOptions few{.times = folder.with("t.csv", "1\n2\n3\n")};
  EXPECT_NE(test::error_of([&] { see(folder / "a.mkv", few); }).find("t.csv: 3 times, "),
            std::string::npos);
  std::string many;
  for (int k = 0; k < 20; ++k) many += std::to_string(0.15 * k) + "\n";
  const Seen seen = see(folder / "a.mkv", {.times = folder.with("t.csv", many)});
  EXPECT_EQ(seen.times.back(), 1.95);
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("t.csv holds 20 times, there are 14 pictures"), std::string::npos);
}

TEST(UnevenTimes, GiveTrueVelocities) {
  // A bright disc that moves at 20 px/s, seen at uneven times.
  VideoTracker tracker({.um_per_px = 1,
                        .find = {.diameter = 9, .tone = ParticleTone::bright, .min_mass = 100},
                        .track = {.search_range = 12, .start_speed = 40}},
                       uneven.back() / static_cast<double>(uneven.size() - 1));
  TrackRow last;
  int ids = 0;
  for (std::size_t k = 0; k < uneven.size(); ++k) {
    formats::Image picture{120, 40, 1, std::vector<std::uint8_t>(120 * 40, 20)};
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 120; ++x) {
        const double dx = x - (12 + 4 * uneven[k] * 5), dy = y - 20;
        picture.pixels[picture.index(x, y)] =
            static_cast<std::uint8_t>(20 + std::lround(150 * std::exp(-(dx * dx + dy * dy) / 8)));
      }
    const auto& rows = tracker.step({static_cast<int>(k), uneven[k], picture});
    ASSERT_EQ(rows.size(), 1U);
    ids = std::max(ids, rows[0].id);
    last = rows[0];
    if (k >= 4) {
      EXPECT_NEAR(last.velocity.x, 20, 1.5) << uneven[k];
    }
  }
}

}  // namespace
}  // namespace microswarm::vision
