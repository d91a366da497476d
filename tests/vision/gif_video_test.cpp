// SPDX-License-Identifier: Apache-2.0
// Animated GIFs, read again by another decoder.
#include <gtest/gtest.h>

#include <filesystem>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"
#include "tests/files.hpp"

namespace microswarm::vision {
namespace {

/// Noise of so many greys with a colour cast; each picture changes a part of the one before.
std::vector<formats::Image> noise(int pictures, int greys, Rng& rng) {
  std::vector<formats::Image> made{{113, 97, 3, std::vector<std::uint8_t>(113 * 97 * 3, 200)}};
  for (int k = 1; k < pictures; ++k) {
    formats::Image next = made.back();
    const int left = 7 * k % 50;
    for (int row = 5 * k % 40; row < 90; ++row)
      for (int column = left; column < 100; ++column) {
        const auto grey = static_cast<std::uint8_t>(rng.uniform(0, greys));
        std::uint8_t* rgb = &next.pixels[next.index(column, row)];
        rgb[0] = grey, rgb[1] = static_cast<std::uint8_t>(255 - grey), rgb[2] = 77;
      }
    made.push_back(next);
  }
  made.push_back(made.back());  // nothing changes
  return made;
}

TEST(GifVideos, ShowEveryPixelAsItWas) {
  const test::Folder folder;
  Rng rng(5, Purpose::test);
  for (const int greys : {1, 2, 3, 16, 254}) {
    const std::vector<formats::Image> pictures = noise(5, greys, rng);
    const auto file = folder / "x.gif";
    VideoFileWriter writer(file, 12.5);
    for (const formats::Image& picture : pictures) writer.add(picture);
    EXPECT_FALSE(std::filesystem::exists(file));
    ASSERT_EQ(writer.commit(), file);
    const auto frames = open_frames(file);
    EXPECT_NEAR(frames->rate().value_or(0), 12.5, 1e-6);
    VideoFrame frame;
    for (const formats::Image& picture : pictures) {
      ASSERT_TRUE(frames->next(frame)) << greys;
      EXPECT_TRUE(frame.picture.pixels == picture.pixels) << greys << " greys";
    }
    EXPECT_FALSE(frames->next(frame));
    std::filesystem::remove(file);
  }
}

TEST(GifVideos, OfManyColoursAreNear) {
  const test::Folder folder;
  formats::Image picture{256, 64, 3, {}};
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 256; ++column)
      for (const int value : {column, 4 * row, 255 - column})
        picture.pixels.push_back(static_cast<std::uint8_t>(value));
  VideoFileWriter writer(folder / "x.gif", 10);
  writer.add(picture);
  ASSERT_TRUE(writer.commit());
  const auto frames = open_frames(folder / "x.gif");
  VideoFrame frame;
  ASSERT_TRUE(frames->next(frame));
  double off = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    off += std::abs(picture.pixels[i] - frame.picture.pixels[i]);
  EXPECT_LT(off / static_cast<double>(picture.pixels.size()),
            8);  // giflib tells five bits a channel apart
}

TEST(GifVideos, HaveAtMostFiftyPicturesASecond) {
  const test::Folder folder;
  EXPECT_THROW(VideoFileWriter(folder / "x.gif", 60), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

}  // namespace
}  // namespace microswarm::vision
