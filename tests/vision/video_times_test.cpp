// SPDX-License-Identifier: Apache-2.0
// Times of pictures: those in a video's container, in tables, in TIFFs and in names.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

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

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

/// Everything that a source tells.
struct Seen {
  std::vector<double> times;
  std::vector<int> greys;  ///< of a pixel of each picture
  std::vector<std::string> notes;
  std::string why_ended;
  std::optional<int> count;
};

Seen see(const fs::path& source, const FrameOptions& options = {}) {
  const auto frames = open_frames(source, options);
  Seen seen;
  VideoFrame frame;
  while (frames->next(frame)) {
    seen.times.push_back(frame.t);
    seen.greys.push_back(frame.picture.pixels[frame.picture.pixels.size() / 2]);
  }
  seen.notes = frames->notes();
  seen.why_ended = frames->why_ended();
  seen.count = frames->count();
  return seen;
}

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
  const auto noise = [](int k, int x, int y) { return (x * 7919 + y * 104729 + k * 31) % 251; };
  for (const Container& c : containers()) {
    SCOPED_TRACE(c.name);
    if (std::string_view(c.name).ends_with(".gif") || std::string_view(c.name).ends_with(".mp4") ||
        std::string_view(c.name).ends_with(".mov"))
      continue;  // its end is not told, or it cannot be opened
    if (!test::write_clip(folder / c.name, c.form, uneven, noise)) continue;
    const std::string whole = read_file(folder / c.name);
    const auto file = folder.with(c.name, whole.substr(0, whole.size() / 2));
    const Seen seen = see(file);
    EXPECT_LT(seen.times.size(), uneven.size());
    EXPECT_TRUE(!seen.why_ended.empty() ||
                seen.count.value_or(0) > static_cast<int>(seen.times.size()));
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

/// A folder of pictures of these names.
void write_pictures(const test::Folder& folder, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    formats::write_png(folder / names[k],
                       {2, 1, 1, std::vector<std::uint8_t>(2, static_cast<std::uint8_t>(k))});
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
  for (int k = 0; k < 20; ++k) many += std::to_string(k) + "\n";
  const Seen seen = see(folder / "a.mkv", {.times = folder.with("t.csv", many)});
  EXPECT_EQ(seen.times.back(), 13);
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("t.csv holds 20 times, there are 14 pictures"), std::string::npos);
}

TEST(Names, AreOrderedByAllTheirNumbers) {
  const std::vector<std::vector<std::string>> ordered{
      {"a1", "a2", "a9", "a10", "a100"},
      {"cam_2024-01-05_10-59-54", "cam_2024-01-05_10-59-59", "cam_2024-01-05_11-00-05"},
      {"frame1_cam1", "frame2_cam1", "frame10_cam1", "frame12_cam1"},
      {"1", "2", "10"},
      {"t1_z2", "t1_z10", "t2_z1"},
      {"x", "x1", "x1a", "x1b", "x02"},
      {"p18446744073709551616", "p18446744073709551617", "p118446744073709551616"}};
  for (const auto& names : ordered)
    for (std::size_t i = 0; i < names.size(); ++i)
      for (std::size_t k = 0; k < names.size(); ++k)
        EXPECT_EQ(naturally_before(names[i], names[k]), i < k) << names[i] << " " << names[k];
  const test::Folder folder;
  write_pictures(folder, {"cam_10-59-54.png", "cam_11-00-05.png"});
  EXPECT_EQ(see(folder / "").greys, (std::vector<int>{0, 1}));
}

/// Names of files in the order in which they are read.
std::vector<std::string> ordered(const std::vector<std::string>& names) {
  std::vector<fs::path> files(names.rbegin(), names.rend());
  sort_naturally(files);
  std::vector<std::string> sorted;
  for (const fs::path& file : files) sorted.push_back(file.string());
  return sorted;
}

TEST(Names, MayHaveSignsDecimalsAndCapitals) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"f-10.png", "f-2.png", "f-1.png", "f0.png", "f3.png", "f11.png"},
        {"f-1.png", "f-2.png", "f-10.png"},  // a hyphen
        {"-2.png", "-1.png", "0.png"},
        {"t0.2.png", "t0.25.png", "t0.3.png", "t1.png", "t1.05.png"},
        {"run1.9.png", "run1.10.png", "run1.11.png"},  // counters
        {"v1.2.9.png", "v1.2.30.png"},
        {"f00.png", "F01.png", "f02.png", "F03.png"}})
    EXPECT_EQ(ordered(names), names) << names[0];
  const std::vector<fs::path> tenths{"t0.1.png", "t0.2.png", "t0.25.png", "t0.3.png", "t0.35.png"};
  const auto found = numbers_in(tenths);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->steps, (std::vector<double>{0, 2, 3, 4, 5}));
}

TEST(Names, OfSeveralChannelsGiveTheOneThatIsChosen) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"f0_ch0.png", "f0_ch1.png", "f1_ch0.png", "f1_ch1.png"},
        {"c1_t1.png", "c2_t1.png", "c1_t2.png", "c2_t2.png"},
        {"x_w1GFP_t1.png", "x_w2RFP_t1.png", "x_w1GFP_t2.png", "x_w2RFP_t2.png"},
        {"t1Channel1.png", "t1Channel2.png", "t2Channel1.png", "t2Channel2.png"}}) {
    const test::Folder folder;
    write_pictures(folder, names);
    EXPECT_NE(test::error_of([&] { see(folder / ""); }).find("2 channels"), std::string::npos)
        << names[0];
    EXPECT_EQ(see(folder / "", {.stack_channel = 2}).greys, (std::vector<int>{1, 3})) << names[0];
  }
  const test::Folder folder;
  write_pictures(folder, {"c0.png", "c1.png", "c2.png"});  // a counter
  EXPECT_EQ(see(folder / "").notes, std::vector<std::string>{});
  const test::Folder words;
  write_pictures(words, {"f0_dark.png", "f0_light.png", "f1_dark.png", "f1_light.png"});
  const Seen seen = see(words / "");
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("f0_dark.png and f0_light.png"), std::string::npos);
}

TEST(Names, OfAPictureInTwoFormatsAreReadOnce) {
  const test::Folder folder;
  write_pictures(folder, {"f0.png", "f1.png", "f2.png"});
  for (const char* name : {"f0.pgm", "f1.pgm"})
    folder.with(name, "P5 2 1 255\n" + std::string(2, '\x63'));
  const Seen seen = see(folder / "");
  EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("2 of 5 pictures"), std::string::npos);
  EXPECT_NE(seen.notes[0].find("f0.png and f0.pgm"), std::string::npos);
}

TEST(Names, OrderIsStrictAndTotal) {
  const std::vector<std::string> names{"a1", "a01", "a", "1", "01", "", "a1b", "a1b2", "b", "10a"};
  std::vector<fs::path> files(names.begin(), names.end());
  sort_naturally(files);
  std::vector<fs::path> again(files.rbegin(), files.rend());
  sort_naturally(again);
  EXPECT_EQ(files, again);
}

TEST(Names, GapsInTheirNumbersAreGapsInTime) {
  const test::Folder folder;
  write_pictures(folder, {"f003.png", "f004.png", "f005.png", "f026.png", "f027.png"});
  const Seen seen = see(folder / "", {.rate = 10});
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(seen.times[k], (std::vector<double>{0, 0.1, 0.2, 2.3, 2.4})[k], 1e-12);
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("1 gap, first between f005.png and f026.png"), std::string::npos);
}

TEST(Names, OfEvenStepsHaveNoGaps) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"f0.png", "f10.png", "f20.png"},
        {"f7.png", "f8.png", "f9.png"},
        {"10-59.png", "11-00.png", "11-05.png"},
        {"a1.png", "b3.png", "c9.png"}}) {
    const test::Folder folder;
    write_pictures(folder, names);
    const Seen seen = see(folder / "", {.rate = 10});
    EXPECT_EQ(seen.times, (std::vector<double>{0, 0.1, 0.2})) << names[0];
    EXPECT_EQ(seen.notes, std::vector<std::string>{});
  }
}

/// A stack whose page k has the grey k, with a description of ImageJ.
fs::path stack(const test::Folder& folder, int pages, const std::string& more) {
  std::vector<std::vector<std::uint8_t>> all;
  for (int k = 0; k < pages; ++k) all.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(
      folder / "s.tif", 2, all,
      {.description = "ImageJ=1.53t\nimages=" + std::to_string(pages) + "\n" + more,
       .resolution = 4});
  return folder / "s.tif";
}

TEST(Stacks, HaveTheScaleAndIntervalOfTheirDescription) {
  const test::Folder folder;
  const auto file = stack(folder, 3, "frames=3\nunit=micron\nfinterval=0.25\n");
  EXPECT_EQ(open_frames(file)->um_per_px(), 0.25);
  const Seen seen = see(file);
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_EQ(seen.notes, (std::vector<std::string>{file.string() +
                                                  ": pictures are 0.25 s apart, as ImageJ tells"}));
  const Seen given = see(file, {.rate = 10});
  EXPECT_EQ(given.times[2], 0.2);
  EXPECT_EQ(given.notes, std::vector<std::string>{});
}

TEST(Stacks, OfSeveralChannelsGiveTheOneThatIsChosen) {
  const test::Folder folder;
  const auto file = stack(folder, 12, "channels=2\nslices=3\nframes=2\nfinterval=1\n");
  const auto error = [&](const FrameOptions& options) {
    return test::error_of([&] { see(file, options); });
  };
  EXPECT_EQ(error({}), file.string() +
                           ": holds 2 channels of 12 pictures in all: choose one with "
                           "stack_channel, 1 to 2");
  EXPECT_EQ(
      error({.stack_channel = 1}),
      file.string() + ": holds 3 slices of 12 pictures in all: choose one with slice, 1 to 3");
  EXPECT_EQ(error({.stack_channel = 3}),
            file.string() + ": stack_channel is 3, the stack has 2 channels");
  EXPECT_EQ(see(file, {.stack_channel = 1, .slice = 1}).greys, (std::vector<int>{0, 6}));
  EXPECT_EQ(see(file, {.stack_channel = 2, .slice = 3}).greys, (std::vector<int>{5, 11}));
}

TEST(Stacks, WithSlicesAloneAreSeries) {
  const test::Folder folder;
  const auto file = stack(folder, 4, "slices=4\n");
  const Seen seen = see(file);
  EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2, 3}));
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("its 4 slices are taken as times"), std::string::npos);
  EXPECT_EQ(see(file, {.slice = 3}).greys, (std::vector<int>{2}));
  const auto two = stack(folder, 6, "channels=2\nslices=3\n");
  EXPECT_EQ(see(two, {.stack_channel = 2}).greys, (std::vector<int>{1, 3, 5}));
}

TEST(Stacks, OfOmeHaveTheTimesOfTheirPlanes) {
  const test::Folder folder;
  std::string planes;
  for (int k = 0; k < 6; ++k)
    planes += "<Plane TheC=\"" + std::to_string(k / 3) + "\" TheZ=\"0\" TheT=\"" +
              std::to_string(k % 3) + "\" DeltaT=\"" + std::to_string(2 + k * k) + "\"/>";
  std::vector<std::vector<std::uint8_t>> pages;
  for (int k = 0; k < 6; ++k) pages.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(
      folder / "s.tif", 2, pages,
      {.description =
           "<OME><Image><Pixels DimensionOrder=\"XYZTC\" SizeC=\"2\" SizeZ=\"1\" SizeT=\"3\" "
           "PhysicalSizeX=\"0.5\"><Channel/>" +
           planes + "</Pixels></Image></OME>"});
  const Seen seen = see(folder / "s.tif", {.stack_channel = 2});
  EXPECT_EQ(seen.greys, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 7, 16}));
  EXPECT_EQ(open_frames(folder / "s.tif", FrameOptions{.stack_channel = 1})->um_per_px(), 0.5);
}

/// A stack whose page k has the grey k, with any description.
fs::path described(const test::Folder& folder, const std::string& name, int pages,
                   const std::string& description) {
  std::vector<std::vector<std::uint8_t>> all;
  for (int k = 0; k < pages; ++k) all.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(folder / name, 2, all, {.description = description});
  return folder / name;
}

/// OME of one image with these TiffData.
std::string ome(int channels, int times, const std::string& data, const std::string& prefix = "") {
  const std::string p = prefix.empty() ? "" : prefix + ":";
  return "<" + p + "OME xmlns" + (prefix.empty() ? "" : ":" + prefix) +
         "=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><" + p + "Image><" + p +
         "Pixels DimensionOrder=\"XYCZT\" SizeC=\"" + std::to_string(channels) +
         "\" SizeZ=\"1\" SizeT=\"" + std::to_string(times) + "\" TimeIncrement=\"0.5\">" + data +
         "</" + p + "Pixels></" + p + "Image></" + p + "OME>";
}

std::string tiff_data(int c, int t, int page, const std::string& file = "") {
  return "<TiffData FirstC=\"" + std::to_string(c) + "\" FirstT=\"" + std::to_string(t) +
         "\" IFD=\"" + std::to_string(page) + "\" PlaneCount=\"1\">" +
         (file.empty() ? "" : "<UUID FileName=\"" + file + "\">urn:uuid:" + file + "</UUID>") +
         "</TiffData>";
}

bool any_names(const std::vector<std::string>& notes, std::string_view what) {
  return std::ranges::any_of(notes, [&](const auto& n) { return n.find(what) != n.npos; });
}

TEST(Stacks, OfOmeAreInTheOrderOfTheirTiffData) {
  const test::Folder folder;
  std::string back, half;
  for (int t = 0; t < 5; ++t) back += tiff_data(0, t, 4 - t);
  const Seen seen = see(described(folder, "b.ome.tif", 5, ome(1, 5, back)));
  EXPECT_EQ(seen.greys, (std::vector<int>{4, 3, 2, 1, 0}));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  // Some order that is neither up nor down, and a run.
  const std::string mixed = tiff_data(0, 0, 2) + tiff_data(0, 1, 0) + tiff_data(0, 2, 1) +
                            "<TiffData FirstT=\"3\" IFD=\"3\" PlaneCount=\"2\"/>";
  EXPECT_EQ(see(described(folder, "m.ome.tif", 5, ome(1, 5, mixed))).greys,
            (std::vector<int>{2, 0, 1, 3, 4}));
  EXPECT_EQ(see(described(folder, "a.ome.tif", 5, ome(1, 5, "<TiffData/>"))).greys,
            (std::vector<int>{0, 1, 2, 3, 4}));
  // What contradicts itself is not followed, and told.
  const Seen odd =
      see(described(folder, "o.ome.tif", 2, ome(1, 2, tiff_data(0, 0, 1) + tiff_data(0, 1, 1))));
  EXPECT_EQ(odd.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(odd.notes, "two TiffData name the same picture"));
}

TEST(Stacks, OfOmeInSeveralFilesGiveThePicturesOfThisOne) {
  const test::Folder folder;
  std::string data, later;
  for (int t = 0; t < 4; ++t)
    for (int c = 0; c < 2; ++c) data += tiff_data(c, t, t, c == 0 ? "c0.ome.tif" : "c1.ome.tif");
  const auto file = described(folder, "c1.ome.tif", 4, ome(2, 4, data));
  for (const FrameOptions& options : {FrameOptions{}, FrameOptions{.stack_channel = 2}}) {
    const Seen seen = see(file, options);
    EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5, 1, 1.5}));
    EXPECT_EQ(seen.why_ended, "");
    EXPECT_TRUE(any_names(seen.notes, "c0.ome.tif"));
  }
  EXPECT_TRUE(any_names(see(file).notes, "of 2 channels only number 2"));
  EXPECT_NE(test::error_of([&] { see(file, {.stack_channel = 1}); }).find("c0.ome.tif"),
            std::string::npos);
  // Every second time is elsewhere.
  for (int t = 0; t < 4; ++t)
    later += tiff_data(0, t, t / 2, t % 2 == 0 ? "even.ome.tif" : "odd.ome.tif");
  const Seen even = see(described(folder, "even.ome.tif", 2, ome(1, 4, later)));
  EXPECT_EQ(even.times, (std::vector<double>{0, 1}));
  EXPECT_TRUE(any_names(even.notes, "gaps in time"));
}

TEST(Stacks, OfOmeMayHaveAPrefixOrAnotherFileForItsDescription) {
  const test::Folder folder;
  const Seen seen = see(described(folder, "p.ome.tif", 2, ome(1, 2, "", "ome")));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5}));
  const Seen binary = see(described(folder, "x.ome.tif", 2,
                                    "<OME><BinaryOnly MetadataFile=\"all.companion.ome\"/></OME>"));
  EXPECT_EQ(binary.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(binary.notes, "all.companion.ome"));
  const std::string one = ome(1, 2, ""), more = one.substr(0, one.size() - 6);
  const std::string image =
      one.substr(one.find("<Image>"), one.rfind("</OME>") - one.find("<Image>"));
  const Seen series = see(described(folder, "s.ome.tif", 4, more + image + "</OME>"));
  EXPECT_EQ(series.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(series.notes, "2 images"));
}

TEST(Stacks, OfTifffileAndScifioHaveChannelsToo) {
  const test::Folder folder;
  for (const std::string text :
       {R"({"shape": [3, 2, 2, 2], "axes": "TCYX"})",
        "SCIFIO=0.42\naxes=X,Y,Channel,Time\nlengths=2,2,2,3\nscales=1,1,1,0.5\n"
        "units=um,um,null,sec\n",
        "SCIFIO=0.42\nimages=6\nchannels=2\nframes=3\nfinterval=0.5\n"}) {
    const auto file = described(folder, "a.tif", 6, text);
    EXPECT_NE(test::error_of([&] { see(file); }).find("2 channels"), std::string::npos) << text;
    const Seen seen = see(file, {.stack_channel = 2});
    EXPECT_EQ(seen.greys, (std::vector<int>{1, 3, 5})) << text;
    EXPECT_EQ(seen.times[1], text[0] == '{' ? 1 : 0.5) << text;
  }
  const auto slow = described(folder, "b.tif", 6, R"({"shape": [2, 3, 2, 2], "axes": "CTYX"})");
  EXPECT_EQ(see(slow, {.stack_channel = 2}).greys, (std::vector<int>{3, 4, 5}));
  const Seen plain = see(described(folder, "c.tif", 3, R"({"shape": [3, 2, 2]})"));
  EXPECT_EQ(plain.greys, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(plain.notes, std::vector<std::string>{});
  EXPECT_TRUE(any_names(see(described(folder, "d.tif", 6, R"({"shape": [3, 2, 2, 2]})")).notes,
                        "without their names"));
}

TEST(Stacks, ThatAreCutEndWithAReason) {
  const test::Folder folder;
  const std::string whole = read_file(stack(folder, 12, "frames=12\n"));
  const auto file = folder.with("cut.tif", whole.substr(0, whole.size() / 2));
  const Seen seen = see(file);
  EXPECT_GT(seen.times.size(), 3U);
  EXPECT_LT(seen.times.size(), 9U);
  EXPECT_NE(seen.why_ended.find("cut.tif: "), std::string::npos);
}

TEST(Stacks, KeepTheScaleOfTheirFirstPictureAndSayWhatIsCut) {
  const test::Folder folder;
  test::write_tiff<float>(folder / "s.tif", 2, {{0.5F, 1.5F}, {1, 2}},
                          {.format = SAMPLEFORMAT_IEEEFP});
  const auto frames = open_frames(folder / "s.tif");
  VideoFrame frame;
  ASSERT_TRUE(frames->next(frame));
  EXPECT_EQ(frame.picture.pixels, (std::vector<std::uint8_t>{0, 255}));
  ASSERT_TRUE(frames->next(frame));
  EXPECT_EQ(frame.picture.pixels, (std::vector<std::uint8_t>{128, 255}));
  const auto notes = frames->notes();
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("0.5 is black, 1.5 is white"), std::string::npos);
  EXPECT_NE(notes[1].find("1 of 2 pictures have samples beyond"), std::string::npos);
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
