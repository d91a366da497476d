// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/rectangles.hpp"
#include "microswarm/formats/choose_map_spec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/matrix.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;
using test::Folder;

/// Matrices of 0 and 1 are told from rectangles by their content, also with four columns.
TEST(MapFile, MatrixOfZerosAndOnes) {
  const Folder folder;
  const auto read = [&](const char* name, std::string_view text, MapChoice choice = {}) {
    choice.um_per_px = 10;
    return read_map_parts(choose_map_spec(folder.with(name, text), choice));
  };
  for (const char* text : {"1 1 1 1\n1 0 1 1\n", "1,1,1,1\n1,0,1,1", "# a\n\n1;1;1;1;\n1;0;1;1;\n",
                           "1\t1\t1\t1\r\n1\t0\t1\t1\r\n", "1111\n1011\n",
                           "1.0 1.0 1.0 1.0\n1.000e+00 0.000e+00 1.000e+00 1.000e+00\n",
                           "% of MATLAB\n// of C\n1 1 1 1\n1 0 1 1\n"}) {
    const MapParts parts = read("m.txt", text);
    EXPECT_EQ(parts.bounds.hi, (Vec2{40, 20})) << text;
    ASSERT_EQ(parts.walls.size(), 1u) << text;
    EXPECT_EQ(bounding_box(parts.walls[0]).lo, (Vec2{10, 0})) << text;
    EXPECT_EQ(area(parts.walls[0]), 100) << text;
    ASSERT_EQ(parts.notes.size(), 1u);
    EXPECT_NE(parts.notes[0].find("map.wall=one"), std::string::npos) << parts.notes[0];
  }
  const MapParts ones = read("m.csv", "1 1 1\n1 0 1\n", {.settings = {"map.wall=one"}});
  EXPECT_EQ(area(ones.walls[0]), 500);
  EXPECT_TRUE(ones.notes.empty());
  EXPECT_TRUE(read("m.csv", "1 0\n", {.settings = {"map.wall=zero"}}).notes.empty());
  const auto box = folder.with("m.txt", "0 0 1 1\n");
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { guess_map_spec(box); }), box.string(),
                                       {"matrix", "missing", "um_per_px"}));
  EXPECT_EQ(
      area(read_map_parts(choose_map_spec(box, {.settings = {"map.type=rectangles"}})).walls[0]),
      1);
  EXPECT_TRUE(std::holds_alternative<RectanglesMap>(
      guess_map_spec(folder.with("r.csv", "0,0,1,1\n0,0,2,1\n"))));
  const auto ragged = folder.with("m.txt", "1 0\n1 0 1\n");
  const MatrixMap spec{.file = ragged.string()};
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { read_map_parts(spec); }),
                                       ragged.string() + ":2", {"3", "2"}));
  folder.with("m.txt", "1 0\n1 2\n");
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { read_map_parts(spec); }),
                                       ragged.string() + ":2", {"2", "0", "1"}));
  // One bad cell makes no table of rectangles of it.
  const auto typo = folder.with("t.txt", "1 0 1;\n1 0 1;\n1 O 1;\n");
  EXPECT_TRUE(test::is_one_line_naming(
      error_of([&] { read_map_parts(choose_map_spec(typo, {.um_per_px = 1})); }),
      typo.string() + ":3", {"'O'", "0", "1"}));
}

/// A few cells that are mistyped leave a matrix one; numbers of which some are 0 and 1 are none.
TEST(MapFile, MatrixIsToldFromOtherTables) {
  for (const char* text :
       {"1 0 1\n1 O 1\n1 1 1\n", "1 0 1\n1 2 1\n1 1 1\n", "10\n01\n", "1 1 0 1\n"})
    EXPECT_TRUE(is_matrix(text)) << text;
  for (const char* text : {"1 0 1\n2 5 7\n3 4 5\n", "1 0 1\n2 5 7\n", "0,0,1,1\n1,0,1,1\n0,0,2,1\n",
                           "0\n1\n0\n", "1 2 3\n", "# 1\n"})
    EXPECT_FALSE(is_matrix(text)) << text;
}

TEST(MapFile, RectanglesOfSpreadsheets) {
  const auto box = [](std::string_view text, double unit = 1) {
    return bounding_box(parse_rectangles(text, "x.csv", unit).at(0));
  };
  EXPECT_EQ(box("\"x\";\"y\";\"w\";\"h\"\n1,5;2;3;4\n").lo, (Vec2{1.5, 2}));
  EXPECT_EQ(box("\"x\",\"y\",\"w\",\"h\"\n\"1\",\"2\",\"3\",\"4\"\n").hi, (Vec2{4, 6}));
  EXPECT_EQ(box("1,2,3,4\n", 1000).hi, (Vec2{4000, 6000}));
}

TEST(MapFile, ColumnsOfRectanglesAreFoundByName) {
  for (const char* table : {"width,height,x,y\n3,4,1,2\n", "Y;X;W;H\n2;1;3;4\n"}) {
    const Box box = bounding_box(parse_rectangles(table, "x.csv").at(0));
    EXPECT_EQ(box.lo, (Vec2{1, 2})) << table;
    EXPECT_EQ(box.hi, (Vec2{4, 6})) << table;
  }
  for (const char* header : {"x1,y1,x2,y2", "left,top,right,bottom", "x_mm,y_mm,width_mm,height_mm",
                             "x,y,width,width", "x,y,width", "name,x,y,width,height"})
    EXPECT_TRUE(test::is_one_line_naming(
        error_of([&] { parse_rectangles(std::string(header) + "\n1,2,3,4\n", "x.csv"); }),
        "x.csv:1", {"width"}))
        << header;
}

TEST(MapFile, RectanglesOfOtherPrograms) {
  const auto first = [](std::string_view text) {
    const Box box = bounding_box(parse_rectangles(text, "x.csv").at(0));
    return std::vector{box.lo.x, box.lo.y, box.width(), box.height()};
  };
  const std::vector wanted{10.5, 20.0, 30.0, 10.0};
  for (const char* text :
       {"10,5\t20\t30\t10\n", "x\ty\twidth\theight\n10,5\t20\t30\t10\n", "10.5,\t20,\t30,\t10\n",
        "sep=;\n10,5;20;30;10\n", "\"\",\"x\",\"y\",\"width\",\"height\"\n\"one\",10.5,20,30,10\n",
        ",y,x,width,height\n0,20,10.5,30,10\n", "x,y,width,height\r10.5,20,30,10\r",
        "\"10,5\",20,30,10\n", "10.5 20\t30 10\n"})
    EXPECT_EQ(first(text), wanted) << text;
  for (const char* text : {"\"1,500\",200,30,10\n", "995.5\t1\t2\t3\n1,010\t2\t3\t4\n",
                           "1,500;200;30;10\n0.5;1;2;3\n"})
    EXPECT_NE(error_of([&] { parse_rectangles(text, "x.csv"); }).find("may be"), std::string::npos)
        << text;
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { parse_rectangles("1,2,3,4,5\n", "x.csv"); }),
                                       "x.csv:1", {"5", "4"}));
}

/// What a table of numbers is taken for, and that it may be another.
TEST(MapFile, ATableThatLooksLikeAMatrixIsTold) {
  const Folder folder;
  const auto notes_of = [&](std::string_view text) {
    const auto file = folder.with("r.csv", text);
    return read_map_parts(RectanglesMap{.file = file.string()}).notes;
  };
  for (const char* text :
       {"1 1 1 1\n1 0 1 1\n1 0 1 2\n", "0 0 255 255\n255 0 255 255\n0 255 255 255\n"}) {
    const auto notes = notes_of(text);
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_NE(notes[0].find("map.type=matrix"), std::string::npos) << notes[0];
  }
  for (const char* text :
       {"0 0 10 20\n30 40 10 20\n50 60 10 20\n", "0.5,0,1,1\n0,0,1,1\n1,1,1,1\n"})
    EXPECT_TRUE(notes_of(text).empty()) << text;
  for (const char* text : {"True False\nFalse True\n", "[[1,0],[0,1]]\n", "0,255\n255,0\n"}) {
    const auto file = folder.with("m.csv", text);
    EXPECT_TRUE(test::is_one_line_naming(error_of([&] { choose_map_spec(file, {.um_per_px = 1}); }),
                                         file.string(), {"rectangles", "um_per_unit", "matrix"}));
  }
  const auto wide = folder.with("u.csv", std::string("\xff\xfe\x31\0\x20\0", 6));
  EXPECT_EQ(error_of([&] { choose_map_spec(wide, {.um_per_px = 1}); }),
            wide.string() + ": is a text in UTF-16: save it in UTF-8");
  for (const auto& [name, text] : {std::pair("m.txt", "1 1\r1 0\r"),
                                   {"m.tsv", "1\t1\n1\t0\n"},
                                   {"q.csv", "\"1\",\"1\"\n\"1\",\"0\"\n"}}) {
    const MapParts parts =
        read_map_parts(choose_map_spec(folder.with(name, text), {.um_per_px = 10}));
    EXPECT_EQ(parts.bounds.hi, (Vec2{20, 20})) << name;
    ASSERT_EQ(parts.walls.size(), 1u) << name;
    EXPECT_EQ(bounding_box(parts.walls[0]).lo, (Vec2{10, 0})) << name;
  }
}

TEST(MapFile, TracksAreNoRectangles) {
  for (const char* text : {"id;t_s;x_um;y_um\n1;0;10;20\n", "frame,x,y,track\n0,1,2,3\n"})
    EXPECT_TRUE(test::is_one_line_naming(error_of([&] { parse_rectangles(text, "x.csv"); }),
                                         "x.csv:1", {"tracks", "width"}));
}

}  // namespace
}  // namespace microswarm::formats
