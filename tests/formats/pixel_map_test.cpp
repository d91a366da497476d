// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/pixel_map.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "microswarm/world/snapshot.hpp"

namespace microswarm::formats {
namespace {

/// Which pixels of a row, between two bright ones, are free.
std::vector<bool> free_pixels(const std::vector<std::uint8_t>& row) {
  const Map map = map_of_pixels(row, row.size(), 1, 10);
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

TEST(PixelMap, APictureThatIsDarkThroughoutIsWall) {
  EXPECT_EQ(free_pixels({2, 1, 100}), (std::vector{false, false, false}));
}

}  // namespace
}  // namespace microswarm::formats
