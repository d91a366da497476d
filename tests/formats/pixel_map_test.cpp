// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/pixel_map.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "microswarm/world/snapshot.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

/// Which pixels of a row, between two bright ones, are free.
std::vector<bool> free_pixels(const std::vector<std::uint8_t>& row,
                              const PixelMapParams& params = {}) {
  const Map map = map_of_pixels(row, row.size(), 1, 10, params).map;
  std::vector<bool> free;
  for (std::size_t i = 0; i < row.size(); ++i)
    free.push_back(map.clearance({10 * static_cast<double>(i) + 5, 5}) > 0);
  return free;
}

TEST(PixelMap, AMaskIsFreeWhereItIsOne) {
  EXPECT_EQ(free_pixels({1, 0, 1, 1}), (std::vector{true, false, true, true}));
}

TEST(PixelMap, AGreyPictureIsFreeFromTheThresholdOfPictures) {
  EXPECT_EQ(free_pixels({200, 20, 127, 128, 1, 0, 255}),
            (std::vector{true, false, false, true, false, false, true}));
}

TEST(PixelMap, AThresholdAndDarkChannelsMayBeGiven) {
  EXPECT_EQ(free_pixels({200, 89, 90}, {.threshold = 90}), (std::vector{true, false, true}));
  EXPECT_EQ(free_pixels({200, 89, 90}, {.threshold = 90, .free = FreePixels::dark}),
            (std::vector{false, true, false}));
  EXPECT_EQ(free_pixels({1, 0}, {.free = FreePixels::dark}), (std::vector{false, true}));
  EXPECT_EQ(test::error_of([] {
              map_of_pixels(std::vector<std::uint8_t>{1, 0}, 2, 1, 10, {.threshold = 2});
            }),
            "all of the image is wall: its largest value is 1, free are pixels of at least 2");
  EXPECT_EQ(
      test::error_of([] {
        map_of_pixels(std::vector<std::uint8_t>{200, 130}, 2, 1, 10, {.free = FreePixels::dark});
      }),
      "all of the image is wall: its smallest value is 130, free are pixels below 128");
}

/// As a picture's file that is all wall, or has no walls.
TEST(PixelMap, OneKindOfPixelsIsRefusedOrTold) {
  const auto complaint = [](const std::vector<std::uint8_t>& row) {
    return test::error_of([&] { map_of_pixels(row, row.size(), 1, 10); });
  };
  EXPECT_EQ(complaint({2, 1, 100}),
            "all of the image is wall: its largest value is 100, free are pixels of at least 128");
  EXPECT_EQ(complaint({0, 1, 2}),
            "all of the image is wall: its largest value is 2, free are pixels of at least 128");
  EXPECT_EQ(complaint({0, 0}), "all of the image is wall: no pixel is free");
  for (const std::vector<std::uint8_t>& row : {std::vector<std::uint8_t>{1, 1}, {200, 128}}) {
    const auto notes = map_of_pixels(row, row.size(), 1, 10).notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("no walls"), std::string::npos);
  }
  EXPECT_TRUE(map_of_pixels(std::vector<std::uint8_t>{0, 1}, 2, 1, 10).notes.empty());
}

}  // namespace
}  // namespace microswarm::formats
