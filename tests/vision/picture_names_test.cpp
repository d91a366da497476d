// SPDX-License-Identifier: Apache-2.0
// Order and times of pictures by their names in a folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/vision/camera/frames.hpp"
#include "microswarm/vision/camera/picture_names.hpp"
#include "tests/files.hpp"
#include "tests/vision/seen.hpp"

namespace microswarm::vision {
namespace {

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
        {"v1.2.9.png", "v1.2.31.png"},
        {"v1.2.9.png", "v1.12.9.png"},
        {"a.png", "a-.png"},  // no sign without a number
        {"f-10.png", "f-2.png", "f0.png", "f+1.png", "f+3.png"},
        {"f-2.png", "f-1.png", "f+1.png", "f+10.png"},
        {"f-a1.png", "f-b0.png", "f-b1.png"},
        {"f00.png", "F01.png", "f02.png", "F03.png"}})
    EXPECT_EQ(ordered(names), names) << names[0];
  const std::vector<fs::path> tenths{"t0.1.png", "t0.2.png", "t0.25.png", "t0.3.png", "t0.35.png"};
  const auto found = numbers_in(tenths);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->steps, (std::vector<double>{0, 2, 3, 4, 5}));
  const auto below_0 = numbers_in({"f-2.png", "f-1.png", "f0.png", "f+2.png"});
  ASSERT_TRUE(below_0);
  EXPECT_EQ(below_0->steps, (std::vector<double>{0, 1, 2, 4}));
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

TEST(Names, OfChannelsOfWhichAPictureIsMissingAreStillChannels) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"f0_ch0.png", "f0_ch1.png", "f1_ch0.png", "f1_ch1.png",
                                 "f2_ch0.png"},
        {"f0_C0.png", "f0_C1.png", "f1_C0.png", "f1_C1.png", "f2_C0.png"},
        {"img_channel000_position000_time000_z000.png",
         "img_channel001_position000_time000_z000.png",
         "img_channel000_position000_time001_z000.png",
         "img_channel001_position000_time001_z000.png",
         "img_channel000_position000_time002_z000.png"}}) {
    const test::Folder folder;
    write_pictures(folder, names);
    EXPECT_NE(test::error_of([&] { see(folder / ""); }).find("2 channels"), std::string::npos)
        << names[0];
    EXPECT_EQ(see(folder / "", {.stack_channel = 1}).greys, (std::vector<int>{0, 2, 4}));
    EXPECT_EQ(see(folder / "", {.stack_channel = 2}).greys, (std::vector<int>{1, 3}));
  }
  const test::Folder words;
  write_pictures(words, {"f0_gfp.png", "f0_rfp.png", "f1_gfp.png", "f1_rfp.png", "f2_gfp.png"});
  const Seen seen = see(words / "");
  ASSERT_FALSE(seen.notes.empty());
  EXPECT_NE(seen.notes[0].find("f0_gfp.png and f0_rfp.png"), std::string::npos);
}

TEST(Names, OfSeveralCamerasPositionsOrWellsAreRefused) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"0000_cam0.png", "0000_cam1.png", "0001_cam0.png",
                                 "0001_cam1.png"},
        {"pos0_t000.png", "pos0_t001.png", "pos1_t000.png", "pos1_t001.png"},
        {"exp_s1_t1.png", "exp_s1_t2.png", "exp_s2_t1.png", "exp_s2_t2.png"},
        {"A01_t00.png", "A01_t01.png", "A02_t00.png", "A02_t01.png"},
        {"img_channel000_position000_time000_z000.png",
         "img_channel000_position000_time001_z000.png",
         "img_channel000_position001_time000_z000.png"}}) {
    const test::Folder folder;
    write_pictures(folder, names);
    EXPECT_NE(test::error_of([&] { see(folder / ""); }).find("a folder of its own"),
              std::string::npos)
        << names[0];
  }
  const test::Folder times;
  write_pictures(times, {"cam_10-59-54.png", "cam_10-59-55.png", "cam_11-00-20.png"});
  const Seen seen = see(times / "");
  EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("more than one number"), std::string::npos);
  const test::Folder hours;
  write_pictures(hours, {"10-59.png", "11-00.png", "11-05.png"});
  EXPECT_EQ(see(hours / "", {.rate = 10}).times, (std::vector<double>{0, 0.1, 0.2}));
  const test::Folder other;
  write_pictures(other, {"f001_cam1.png", "f002_cam2.png", "f010_cam1.png"});
  EXPECT_EQ(see(other / "").notes.size(), 1U);
}

TEST(Names, OfStrayPicturesAmongNumberedOnesAreLeftOut) {
  for (const std::string stray :
       {"background.png", "empty.png", "bg001.png", "mask.png", "f000-overlay.png", "thumb.png"}) {
    const test::Folder folder;
    write_pictures(folder, {"f000.png", "f001.png", "f002.png", "f003.png", stray});
    const Seen seen = see(folder / "");
    EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2, 3})) << stray;
    ASSERT_EQ(seen.notes.size(), 1U) << stray;
    EXPECT_NE(seen.notes[0].find(stray + " is left out"), std::string::npos) << seen.notes[0];
  }
  const test::Folder folder;
  write_pictures(folder, {"img.png", "img (1).png", "img (2).png", "img (3).png"});
  EXPECT_EQ(see(folder / "").greys, (std::vector<int>{0, 1, 2, 3}));
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

/// TIFF before PNG before others before JPEG, which loses what the others keep.
TEST(Names, OfTwoFormatsTheOneWithoutLossIsRead) {
  for (const auto& [better, worse] :
       std::vector<std::pair<std::string, std::string>>{{"tif", "png"},
                                                        {"tiff", "bmp"},
                                                        {"png", "ppm"},
                                                        {"png", "bmp"},
                                                        {"pgm", "jpg"},
                                                        {"pgm", "jpeg"},
                                                        {"bmp", "jpg"}}) {
    std::vector<fs::path> files{"a." + worse, "a." + better, "b." + better, "b." + worse};
    EXPECT_EQ(choose_pictures(files, {}, {}, "d").size(), 1U);
    EXPECT_EQ(files, (std::vector<fs::path>{"a." + better, "b." + better})) << better;
  }
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
        {"a1.png", "b3.png", "c9.png"}}) {
    const test::Folder folder;
    write_pictures(folder, names);
    const Seen seen = see(folder / "", {.rate = 10});
    EXPECT_EQ(seen.times, (std::vector<double>{0, 0.1, 0.2})) << names[0];
    EXPECT_EQ(seen.notes, std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace microswarm::vision
