// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ros.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm {
namespace {

using test::error_of;
using Cells = std::vector<std::uint8_t>;

constexpr std::string_view plain = "image: a.pgm\nresolution: 0.05\norigin: [-1, 2, 0]\n";

RosHeader parsed_header(std::string_view text) { return parse_ros_header(text, "x.yaml"); }

TEST(Ros, HeaderWithDefaults) {
  const RosHeader header = parsed_header(plain);
  EXPECT_EQ(header.image, "a.pgm");
  EXPECT_EQ(header.resolution, 0.05);
  EXPECT_EQ(header.origin, (std::vector<double>{-1, 2, 0}));
  EXPECT_EQ(header.occupied_thresh, 0.65);
  EXPECT_EQ(header.free_thresh, 0.196);
  EXPECT_EQ(header.mode, RosMode::trinary);
}

TEST(Ros, WrittenAndReadAgain) {
  RosHeader header = parsed_header(plain);
  header.mode = RosMode::raw;
  header.negate = 1;
  header.free_thresh = 0.1;
  EXPECT_EQ(ros_header_text(parsed_header(ros_header_text(header))), ros_header_text(header));
}

TEST(Ros, OccupiedAndUnknownAreWalls) {
  const Image image{4, 1, 1, {0, 205, 254, 89}};
  const RosHeader header = parsed_header(plain);
  EXPECT_EQ(ros_walls(image, header).cells, (Cells{1, 1, 0, 1}));
  EXPECT_EQ(ros_walls(image, header, true).cells, (Cells{1, 0, 0, 1}));
}

TEST(Ros, NegateAndRaw) {
  RosHeader header = parsed_header(plain);
  header.negate = 1;
  EXPECT_EQ(ros_walls({2, 1, 1, {0, 255}}, header).cells, (Cells{0, 1}));
  header.mode = RosMode::raw;
  EXPECT_EQ(ros_walls({4, 1, 1, {0, 66, 100, 255}}, header).cells, (Cells{0, 1, 1, 1}));
  EXPECT_EQ(ros_walls({4, 1, 1, {0, 40, 100, 255}}, header, true).cells, (Cells{0, 0, 1, 0}));
}

TEST(Ros, ColoursCountByTheirMean) {
  const RosHeader header = parsed_header(plain);
  EXPECT_EQ(ros_walls({2, 1, 3, {255, 255, 255, 255, 0, 0}}, header).cells, (Cells{0, 1}));
}

TEST(RosErrors, NameFileAndValue) {
  const auto complaint = [](const std::string& text) {
    return error_of([&] { parsed_header(text); });
  };
  EXPECT_NE(complaint("image: a.pgm\norigin: [0, 0, 0]\n").find("resolution"), std::string::npos);
  EXPECT_NE(complaint("resolution: 1\norigin: [0, 0, 0]\n").find("image"), std::string::npos);
  EXPECT_EQ(complaint("image: a\nresolution: 1\norigin: [0, 0]\n"),
            "x.yaml: origin of 2 numbers, 3 expected: x, y, yaw");
  EXPECT_TRUE(test::is_one_line_naming(complaint("image: a\nresolution: 1\norigin: [0, 0, 0.5]\n"),
                                       "x.yaml", {"0.5", "0"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(std::string(plain) + "free_thresh: 0.9\n"),
                                       "x.yaml",
                                       {"free_thresh", "0.9", "occupied_thresh", "0.65"}));
  EXPECT_NE(complaint("image: a\nresolution: -1\norigin: [0, 0, 0]\n").find("x.yaml:2:"),
            std::string::npos);
  EXPECT_NE(complaint("image: a\nresolution: .nan\norigin: [0, 0, 0]\n").find("x.yaml:2:"),
            std::string::npos);
}

}  // namespace
}  // namespace microswarm
