// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ros.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/map_file.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;
using test::Folder;
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
  header.mode = RosMode::scale;
  header.negate = 1;
  header.image = "a map #1: \"x\".pgm";
  header.free_thresh = 0.1;
  const RosHeader again = parsed_header(ros_header_text(header));
  EXPECT_EQ(ros_header_text(again), ros_header_text(header));
  EXPECT_EQ(again.image, header.image);
  EXPECT_EQ(again.origin, header.origin);
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
  header.negate = 0;
  header.mode = RosMode::raw;
  EXPECT_EQ(ros_walls({4, 1, 1, {0, 66, 100, 255}}, header).cells, (Cells{0, 1, 1, 1}));
  EXPECT_EQ(ros_walls({4, 1, 1, {0, 40, 100, 255}}, header, true).cells, (Cells{0, 0, 1, 0}));
}

/// How map_server reads a pixel of occupancy, from its description: p > occupied_thresh is
/// occupied, p < free_thresh is free, all else unknown.
TEST(Ros, EveryPixelIsReadAsMapServerReadsIt) {
  for (const auto& [occupied, free] : {std::pair{0.65, 0.196}, {0.65, 0.25}, {0.5, 0.5}, {1., 0.}})
    for (const int negate : {0, 1})
      for (const RosMode mode : {RosMode::trinary, RosMode::scale, RosMode::raw}) {
        if (mode == RosMode::raw && negate == 1) continue;
        RosHeader header = parsed_header(plain);
        header.occupied_thresh = occupied, header.free_thresh = free;
        header.negate = negate, header.mode = mode;
        for (int x = 0; x < 256; ++x) {
          double p = negate ? x / 255. : (255 - x) / 255.;
          if (mode == RosMode::raw) p = x > 100 ? (occupied + free) / 2 : x / 100.;
          const bool is_occupied = p > occupied, is_free = p < free;
          const Image image{1, 1, 1, {static_cast<std::uint8_t>(x)}};
          EXPECT_EQ(ros_walls(image, header).cells[0], !is_free) << x << " " << free;
          EXPECT_EQ(ros_walls(image, header, true).cells[0], is_occupied) << x << " " << occupied;
        }
      }
}

/// Both forms of map_saver: ROS 1 writes a blank line at the end and no mode, ROS 2 a mode.
TEST(Ros, WhatMapSaverWritesIsRead) {
  const RosHeader first = parsed_header(
      "image: map.pgm\nresolution: 0.050000\norigin: [-10.000000, -10.000000, 0.000000]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n");
  EXPECT_EQ(first.origin, (std::vector<double>{-10, -10, 0}));
  const RosHeader second = parsed_header(
      "image: map.png\nmode: scale\nresolution: 0.05\norigin: [-1.25, 2.5, 0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.25");
  EXPECT_EQ(second.mode, RosMode::scale);
  EXPECT_EQ(second.free_thresh, 0.25);
}

/// A picture of map_saver has 0, 205 and 254 only: 205 is unknown there whatever free_thresh is.
TEST(Ros, UnknownOfMapSaverStaysUnknown) {
  RosHeader header = parsed_header(plain);
  header.free_thresh = 0.25;
  const Image saved{5, 1, 1, {0, 205, 254, 205, 255}};
  EXPECT_TRUE(find_saver_unknown(saved, header).is_of_map_saver);
  EXPECT_EQ(find_saver_unknown(saved, header).cells, 2u);
  EXPECT_EQ(ros_walls(saved, header).cells, (Cells{1, 1, 0, 1, 0}));
  EXPECT_EQ(ros_walls(saved, header, true).cells, (Cells{1, 0, 0, 0, 0}));

  const Image edited{3, 1, 1, {0, 205, 255}};
  EXPECT_TRUE(find_saver_unknown(edited, header).is_of_map_saver);
  EXPECT_EQ(ros_walls(edited, header).cells, (Cells{1, 1, 0}));
  const Image lossy{5, 1, 1, {3, 205, 203, 206, 252}};
  EXPECT_EQ(find_saver_unknown(lossy, header).lost, 2u);  // 205 and 203

  const Image shaded{4, 1, 1, {0, 205, 254, 220}};  // somebody's shades of grey
  EXPECT_FALSE(find_saver_unknown(shaded, header).is_of_map_saver);
  EXPECT_EQ(find_saver_unknown(shaded, header).cells, 1u);
  EXPECT_EQ(ros_walls(shaded, header).cells, (Cells{1, 0, 0, 0}));

  header.free_thresh = 0.196;  // 205 is unknown anyway
  EXPECT_EQ(find_saver_unknown(saved, header).cells, 0u);
  header.free_thresh = 0.25;
  header.mode = RosMode::scale;  // where unknown is transparent
  EXPECT_EQ(find_saver_unknown(saved, header).cells, 0u);
  EXPECT_EQ(ros_walls(saved, header).cells, (Cells{1, 0, 0, 0, 0}));
}

TEST(Ros, FormsThatNav2Reads) {
  for (const char* yes : {"1", "true", "True", "yes"})
    EXPECT_EQ(parsed_header(std::string(plain) + "negate: " + yes + "\n").negate, 1) << yes;
  for (const char* no : {"0", "false", "False", "no"})
    EXPECT_EQ(parsed_header(std::string(plain) + "negate: " + no + "\n").negate, 0) << no;
  for (const char* mode : {"scale", "Scale", "SCALE", "\"Scale\""})
    EXPECT_EQ(parsed_header(std::string(plain) + "mode: " + mode + "\n").mode, RosMode::scale);
  const RosHeader header =
      parsed_header(std::string(plain) + "frame_id: map\nextra: {a: [1]}\nnegate: 1\n");
  EXPECT_EQ(header.unread, (std::vector<std::string>{"frame_id", "extra"}));
  EXPECT_EQ(header.negate, 1);
  EXPECT_EQ(parsed_header("image: a\nresolution: 1\norigin: [0, 0, -1.5]\n").origin[2], -1.5);
}

TEST(Ros, TransparentIsUnknown) {
  const Image image{3, 1, 1, {254, 254, 0}};
  const RosHeader header = parsed_header(plain);
  const Cells transparent{0, 1, 1};
  EXPECT_EQ(ros_walls(image, header, false, transparent).cells, (Cells{0, 1, 1}));
  EXPECT_EQ(ros_walls(image, header, true, transparent).cells, (Cells{0, 0, 0}));
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
  EXPECT_TRUE(test::is_one_line_naming(complaint("image: a\nresolution: 1\norigin: [0, 0, -nan]\n"),
                                       "x.yaml:3:16", {"yaw", "-nan", "write 0"}));
  EXPECT_NE(complaint(std::string(plain) + "free_tresh: 0.1\n").find("free_thresh"),
            std::string::npos);
  EXPECT_TRUE(test::is_one_line_naming(complaint(std::string(plain) + "free_thresh: 0.9\n"),
                                       "x.yaml",
                                       {"free_thresh", "0.9", "occupied_thresh", "0.65"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(std::string(plain) + "mode: raw\nnegate: 1\n"),
                                       "x.yaml", {"negate", "raw"}));
  EXPECT_NE(complaint(std::string(plain) + "mode: percent\n").find("mode"), std::string::npos);
  EXPECT_NE(complaint("image: a\nresolution: -1\norigin: [0, 0, 0]\n").find("x.yaml:2:"),
            std::string::npos);
  EXPECT_NE(complaint("image: a\nresolution: .nan\norigin: [0, 0, 0]\n").find("x.yaml:2:"),
            std::string::npos);
}

/// A yaw as programs round it turns a map by quarters exactly; one of a hundredth of a cell is
/// none.
TEST(Ros, MapIsNotTurnedByRounding) {
  const Folder folder;
  Image image{3, 4, 1, std::vector<std::uint8_t>(12, 254)};
  image.pixels[1] = 0;
  folder.with("a.pgm", encode_pnm(image));
  const auto parts = [&](const std::string& yaw) {
    folder.with("a.yaml", "image: a.pgm\nresolution: 1\norigin: [2, 3, " + yaw + "]\n");
    return read_map_parts(RosMap{.file = "a.yaml", .um_per_m = 10}, folder / "");
  };
  const auto same = [&](const char* a, const char* b) {
    return fingerprint(parts(a)) == fingerprint(parts(b));
  };
  for (const char* none : {"1e-9", "-1e-9", "0.0019", "6.283185", "-12.56637"})
    EXPECT_TRUE(same("0", none)) << none;
  for (const char* quarter : {"1.5708", "-4.712389"})
    EXPECT_TRUE(same("1.5707963267948966", quarter)) << quarter;
  EXPECT_TRUE(same("3.141592653589793", "-3.1416"));
  EXPECT_FALSE(same("0", "0.0021"));  // of a diagonal of 5 cells
  const Box quarter = parts("1.5708").bounds;
  EXPECT_EQ(quarter.lo, (Vec2{-20, 30}));
  EXPECT_EQ(quarter.hi, (Vec2{20, 60}));
}

TEST(Ros, AYawInDegreesIsNoted) {
  const Folder folder;
  folder.with("a.pgm", encode_pnm(Image{2, 1, 1, {0, 254}}));
  const auto notes = [&](const std::string& yaw) {
    folder.with("a.yaml", "image: a.pgm\nresolution: 1\norigin: [0, 0, " + yaw + "]\n");
    return read_map_parts(RosMap{.file = "a.yaml"}, folder / "").notes;
  };
  for (const char* rad : {"0", "-3.2", "6.283", "-6.283"}) EXPECT_TRUE(notes(rad).empty()) << rad;
  for (const char* degrees : {"90", "-90", "6.3"}) ASSERT_EQ(notes(degrees).size(), 1u) << degrees;
  EXPECT_NE(notes("90")[0].find("if it is 90°, write 1.570796"), std::string::npos)
      << notes("90")[0];
}

}  // namespace
}  // namespace microswarm::formats
