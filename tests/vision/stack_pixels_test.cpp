// SPDX-License-Identifier: Apache-2.0
// Channels of a stack that are the samples of its pixels.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "microswarm/vision/camera/frames.hpp"
#include "tests/files.hpp"
#include "tests/formats/tiff_writer.hpp"
#include "tests/vision/seen.hpp"

namespace microswarm::vision {
namespace {

/// Channels may be the samples of each pixel.
TEST(StackPixels, OfSeveralSamplesAPixelGiveTheOneThatIsChosen) {
  const test::Folder folder;
  std::vector<std::vector<std::uint8_t>> pages;
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::uint8_t>(k), b = static_cast<std::uint8_t>(10 + k);
    pages.push_back({a, b, a, b, a, b, a, b});
  }
  for (const char* description :
       {"", R"({"shape": [3, 2, 2, 2]})", R"({"shape": [3, 2, 2, 2], "axes": "TYXC"})"}) {
    const auto file = folder / "s.tif";
    test::write_tiff<std::uint8_t>(file, 2, pages, {.samples = 2, .description = description});
    EXPECT_NE(test::error_of([&] { see(file); }).find("holds 2 channels"), std::string::npos);
    EXPECT_EQ(see(file, {.stack_channel = 1}).greys, (std::vector<int>{0, 1, 2})) << description;
    const Seen second = see(file, {.stack_channel = 2});
    EXPECT_EQ(second.greys, (std::vector<int>{10, 11, 12})) << description;
    EXPECT_TRUE(second.notes.empty()) << second.notes.at(0);
    EXPECT_NE(test::error_of([&] { see(file, {.stack_channel = 3}); }).find("has 2 channels"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace microswarm::vision
