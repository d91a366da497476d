// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/track_overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace microswarm::vision {
namespace {

TEST(TrackOverlay, DrawsOnAPictureOfItsSize) {
  TrackOverlay overlay(0.5);
  const VideoFrame frame{0, 0, {120, 90, 1, std::vector<std::uint8_t>(120 * 90, 50)}};
  const formats::Image shown = overlay.draw(frame, {{.id = 3, .position = {30, 22}, .radius = 2}});
  EXPECT_EQ(shown.width, 120);
  EXPECT_EQ(shown.channels, 3);
  const std::size_t ring = shown.index(59 + 6, 90 - 1 - 44);
  EXPECT_NE(shown.pixels[ring], shown.pixels[ring + 2]);  // there is colour
}

TEST(TrackOverlay, ShrinksPicturesThatAnEncoderWouldNeedGigabytesFor) {
  EXPECT_EQ(TrackOverlay::size({2048, 2048}), (PictureSize{2048, 2048}));
  EXPECT_EQ(TrackOverlay::size({4096, 1024}), (PictureSize{4096, 1024}));
  EXPECT_EQ(TrackOverlay::size({8000, 8000}), (PictureSize{2048, 2048}));
  for (const PictureSize given : {PictureSize{2050, 2048}, {1, 30000}, {8191, 513}, {65000, 70}}) {
    const PictureSize size = TrackOverlay::size(given);
    EXPECT_LE(size.width * size.height, TrackOverlay::max_pixels);
    EXPECT_GE(std::min(size.width, size.height), 1);
  }

  TrackOverlay overlay(0.5);
  const VideoFrame frame{0, 0, {4000, 3000, 1, std::vector<std::uint8_t>(4000 * 3000, 50)}};
  const formats::Image shown =
      overlay.draw(frame, {{.id = 3, .position = {1000, 750}, .radius = 100}});
  const PictureSize size = TrackOverlay::size({4000, 3000});
  EXPECT_EQ(shown.width, size.width);
  EXPECT_EQ(shown.height, size.height);
  const double times = size.width / 4000.0;
  int on_ring = 0;  // a circle is where the robot is, and as large
  for (int x = 0; x < 6; ++x)
    on_ring +=
        shown.pixels[shown.index(static_cast<int>((2000 + 200) * times) + x, shown.height / 2)] !=
        50;
  EXPECT_GE(on_ring, 1);
}

}  // namespace
}  // namespace microswarm::vision
