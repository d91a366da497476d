// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/moving_ai.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/formats/map_file.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;

constexpr std::string_view small = "type octile\nheight 2\nwidth 6\nmap\n.GS@TW\nOO....\n";

Mask parsed_octile(std::string_view text) { return parse_moving_ai(text, "x.map"); }
std::string octile_complaint(std::string_view text) {
  return error_of([&] { parsed_octile(text); });
}

TEST(MovingAi, DotsGrassAndSwampAreFree) {
  const Mask mask = parsed_octile(small);
  EXPECT_EQ(mask.width, 6);
  EXPECT_EQ(mask.height, 2);
  EXPECT_EQ(mask.cells, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 0}));
}

TEST(MovingAi, OtherLineEndsAndBlankLinesAtTheEnd) {
  std::string crlf;
  for (const char c : small) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(parsed_octile(crlf), parsed_octile(small));
  EXPECT_EQ(parsed_octile(std::string(small) + "\n \n"), parsed_octile(small));
  EXPECT_EQ(parsed_octile("type tile\nheight 1\nwidth 1\nmap\n."), Mask(1, 1));
}

TEST(MovingAi, LettersThatTheFormatDoesNotHaveAreTold) {
  std::string unknown;
  parse_moving_ai("type octile\nheight 2\nwidth 7\nmap\n.GS@OTW\n.......\n", "x.map", &unknown);
  EXPECT_EQ(unknown, "");
  parse_moving_ai("type octile\rheight 2\rwidth 3\rmap\r101\r.#0\r", "x.map", &unknown);
  EXPECT_EQ(unknown, "10#");
  const test::Folder folder;
  const auto file = folder.with("x.map", "type octile\nheight 1\nwidth 3\nmap\n101\n");
  const auto notes = read_map_parts(MovingAiMap{.file = file.string()}).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("all cells are walls"), std::string::npos);
  EXPECT_NE(notes[1].find("'10'"), std::string::npos);
}

TEST(MovingAi, WrittenAndReadAgain) {
  EXPECT_EQ(parsed_octile(moving_ai_text(parsed_octile(small))), parsed_octile(small));
}

TEST(MovingAiErrors, NameTheLine) {
  EXPECT_EQ(octile_complaint(""), "x.map: 'type ...' expected, not ''");
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type cube\n"), "x.map:1", {"type", "cube"}));
  EXPECT_TRUE(test::is_one_line_naming(octile_complaint("type octile\nwidth 2"), "x.map:2",
                                       {"height ...", "width 2"}));
  EXPECT_TRUE(test::is_one_line_naming(octile_complaint("type octile\nheight x\n"), "x.map:2",
                                       {"height", "x"}));
  EXPECT_TRUE(test::is_one_line_naming(octile_complaint("type octile\nheight -3\n"), "x.map:2",
                                       {"height", "-3", "0..1000000000"}));
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type octile\nheight 20000\nwidth 20000\nmap\n"),
                               "x.map", {"20000 × 20000", "cells", "16384", "side"}));
  EXPECT_TRUE(test::is_one_line_naming(octile_complaint("type octile\nheight 0\nwidth 2\nmap\n"),
                                       "x.map", {"2 × 0", "cells", "1 × 1"}));
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type octile\nheight 8000\nwidth 8000\nmap\n..\n"),
                               "x.map:4", {"64000000", "cells", "42", "bytes"}));
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type octile\nheight 2\nwidth 2\nmap\n..\n"),
                               "x.map:5", {"truncated", "2", "rows", "1"}));
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type octile\nheight 1\nwidth 2\nmap\n...\n"),
                               "x.map:5", {"row", "3", "cells", "2"}));
  EXPECT_TRUE(
      test::is_one_line_naming(octile_complaint("type octile\nheight 1\nwidth 2\nmap\n.\x01\n"),
                               "x.map:5", {"column", "2"}));
  EXPECT_TRUE(test::is_one_line_naming(
      octile_complaint("type octile\nheight 1\nwidth 1\nmap\n.\n.\n"), "x.map:6", {"1", "rows"}));
}

TEST(Scenarios, QueriesAndTheirErrors) {
  const auto parse_all = [](std::string_view text) { return parse_scenarios(text, "x.scen"); };
  const std::vector<GridQuery> queries =
      parse_all("version 1\n3\tmaps/a.map\t49\t50\t1\t11\t2\t12\t1.41421356\n");
  ASSERT_EQ(queries.size(), 1u);
  EXPECT_EQ(queries[0].map, "maps/a.map");
  EXPECT_EQ(queries[0].width, 49);
  EXPECT_EQ(queries[0].height, 50);
  EXPECT_EQ(queries[0].start, (GridCell{1, 11}));
  EXPECT_EQ(queries[0].goal, (GridCell{2, 12}));
  EXPECT_EQ(queries[0].optimal_length, 1.41421356);

  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { parse_all("version 2\n"); }), "x.scen:1",
                                       {"version", "2", "1"}));
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { parse_all("version 1\n1 2 3\n"); }),
                                       "x.scen:2", {"9", "fields", "1"}));
  EXPECT_TRUE(test::is_one_line_naming(
      error_of([&] { parse_all("version 1\n0\ta\t9\t9\t9\t0\t0\t0\t1\n"); }), "x.scen:2",
      {"start", "9", "0..8"}));
  EXPECT_TRUE(test::is_one_line_naming(
      error_of([&] { parse_all("version 1\n0\ta\t9\t9\t0\t0\t0\t0\t-1\n"); }), "x.scen:2",
      {"length", "-1"}));
}

}  // namespace
}  // namespace microswarm::formats
