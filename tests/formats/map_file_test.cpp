// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/choose_map_spec.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/rectangles.hpp"
#include "tests/files.hpp"
#include "tests/formats/png.hpp"
#include "tests/formats/tiff_writer.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;
using test::Folder;

/// 4 × 3 pixels, white but for the one at the top left.
Image corner_picture() {
  Image image{4, 3, 1, std::vector<std::uint8_t>(12, 255)};
  image.pixels[0] = 0;
  return image;
}

TEST(MapFile, PictureHasYUp) {
  const Folder folder;
  write_png(folder / "a.png", corner_picture());
  const LoadedMap map = load_map(ImageMap{.file = "a.png", .um_per_px = 10}, folder / "");
  EXPECT_EQ(map.map->bounds().hi, (Vec2{40, 30}));
  EXPECT_FALSE(map.map->is_free(Vec2{5, 25}, 0));
  EXPECT_TRUE(map.map->is_free(Vec2{5, 5}, 0));
  EXPECT_TRUE(map.map->is_free(Vec2{35, 25}, 0));
  EXPECT_EQ(map.map->clearance(Vec2{15, 25}), 5);
}

TEST(MapFile, ThresholdAndDarkFree) {
  const Folder folder;
  write_png(folder / "a.png", {3, 1, 1, {99, 100, 200}});
  const auto walls = [&](int threshold, FreePixels free) {
    const ImageMap spec{.file = "a.png", .um_per_px = 1, .threshold = threshold, .free = free};
    double sum = 0;
    for (const Polygon& wall : read_map_parts(spec, folder / "").walls) sum += area(wall);
    return sum;
  };
  EXPECT_EQ(walls(100, FreePixels::bright), 1);
  EXPECT_EQ(walls(100, FreePixels::dark), 2);
  EXPECT_EQ(walls(0, FreePixels::bright), 0);
}

TEST(MapFile, RosPairStandsAtItsOrigin) {
  const Folder folder;
  folder.with("a.pgm", encode_pnm(corner_picture()));
  folder.with("a.yaml", "image: a.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\n");
  const LoadedMap map = load_map(RosMap{.file = "a.yaml", .um_per_m = 10}, folder / "");
  EXPECT_EQ(map.map->bounds().lo, (Vec2{-10, 20}));
  EXPECT_EQ(map.map->bounds().hi, (Vec2{10, 35}));
  EXPECT_FALSE(map.map->is_free(Vec2{-9, 34}, 0));
  EXPECT_TRUE(map.map->is_free(Vec2{-9, 21}, 0));
}

/// A cell's centre, turned about the origin, is as free as the cell; what is beyond is a wall.
TEST(MapFile, RosMapIsTurnedByTheYawOfItsOrigin) {
  const Folder folder;
  Image image{7, 5, 1, std::vector<std::uint8_t>(35, 254)};
  for (const int wall : {0, 3, 11, 17, 18, 24, 34})
    image.pixels[static_cast<std::size_t>(wall)] = 0;
  folder.with("a.pgm", encode_pnm(image));
  for (const double yaw : {0.3, 1.5707963267948966, -2.0, 3.141592653589793, 4.0}) {
    folder.with("a.yaml", "image: a.pgm\nresolution: 2\norigin: [-10, 30, " + number_text(yaw) +
                              "]\nnegate: 0\n");
    const LoadedMap map = load_map(RosMap{.file = "a.yaml", .um_per_m = 10}, folder / "");
    const Vec2 origin{-100, 300};
    const auto place = [&](double column, double row) {
      return origin + rotated({20 * column, 20 * (5 - row)}, yaw);
    };
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 7; ++column) {
        const bool wall = image.pixels[static_cast<std::size_t>(7 * row + column)] == 0;
        EXPECT_EQ(map.map->is_free(place(column + 0.5, row + 0.5), 0), !wall) << yaw;
      }
    for (const Vec2 beyond : {place(-0.5, 2), place(7.5, 2), place(3, -0.5), place(3, 5.5)})
      EXPECT_FALSE(map.map->is_free(beyond, 0)) << yaw;
    EXPECT_NEAR(map.map->clearance(place(5.5, 4.5)), 10, 1e-9) << yaw;
    for (const Vec2 corner : {place(0, 0), place(7, 0), place(0, 5), place(7, 5)})
      EXPECT_TRUE(map.map->bounds().grown(1e-9).contains(corner)) << yaw;
  }
}

TEST(MapFile, RosMapTellsWhatItAssumesAndLeavesOut) {
  const Folder folder;
  const auto notes = [&](std::vector<std::uint8_t> pixels, bool unknown_free) {
    folder.with("a.pgm", encode_pnm(Image{static_cast<int>(pixels.size()), 1, 1, pixels}));
    folder.with("a.yaml",
                "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nfree_thresh: 0.25\nframe_id: m\n");
    return read_map_parts(RosMap{.file = "a.yaml", .unknown_free = unknown_free}, folder / "")
        .notes;
  };
  const auto saved = notes({0, 205, 254, 205}, false);
  ASSERT_EQ(saved.size(), 2u);
  EXPECT_NE(saved[0].find("2 cells of grey 205"), std::string::npos) << saved[0];
  EXPECT_NE(saved[0].find("are walls"), std::string::npos) << saved[0];
  EXPECT_NE(saved[1].find("frame_id"), std::string::npos) << saved[1];
  const auto shaded = notes({0, 205, 254, 210}, false);
  EXPECT_NE(shaded[0].find("1 cells of grey 205"), std::string::npos) << shaded[0];
  EXPECT_NE(shaded[0].find("are free"), std::string::npos) << shaded[0];
  EXPECT_EQ(notes({0, 205, 254}, true).size(), 1u);
  EXPECT_EQ(notes({0, 254}, false).size(), 1u);
}

TEST(MapFile, TransparentPixelsOfARosMapAreUnknown) {
  const Folder folder;
  const std::string row("\0\xfe\xff\xfe\x00\x00\xff", 7);  // free, transparent, occupied
  folder.with("a.png", test::png(3, 1, 8, test::grey_alpha, row));
  folder.with("a.yaml", "image: a.png\nmode: scale\nresolution: 1\norigin: [0, 0, 0]\n");
  for (const bool unknown_free : {false, true}) {
    const RosMap spec{.file = "a.yaml", .um_per_m = 1, .unknown_free = unknown_free};
    const LoadedMap map = load_map(spec, folder / "");
    EXPECT_TRUE(map.map->is_free(Vec2{0.5, 0.5}, 0));
    EXPECT_EQ(map.map->is_free(Vec2{1.5, 0.5}, 0), unknown_free);
    EXPECT_FALSE(map.map->is_free(Vec2{2.5, 0.5}, 0));
  }
}

TEST(MapFile, GridMapAndGeoJson) {
  const Folder folder;
  folder.with("a.map", "type octile\nheight 1\nwidth 2\nmap\n@.\n");
  const LoadedMap grid = load_map(MovingAiMap{.file = "a.map", .um_per_cell = 8}, folder / "");
  EXPECT_EQ(grid.map->bounds().hi, (Vec2{16, 8}));
  EXPECT_FALSE(grid.map->is_free(Vec2{4, 4}, 0));
  folder.with("a.geojson",
              R"({"type":"FeatureCollection","bbox":[0,0,9,9],"features":[{"type":"Feature",)"
              R"("properties":{"radius":1},"geometry":{"type":"Point","coordinates":[4,4]}}]})");
  const LoadedMap discs = load_map(GeoJsonMap{.file = "a.geojson", .um_per_unit = 2}, folder / "");
  EXPECT_EQ(discs.map->bounds().hi, (Vec2{18, 18}));
  EXPECT_EQ(discs.map->clearance(Vec2{8, 11}), 1);
}

TEST(MapFile, RectanglesFromListAndFile) {
  const Folder folder;
  folder.with("a.csv", "x_um,y_um,width_um,height_um\n# one\n20,0,10,5\n");
  RectanglesMap spec;
  spec.rectangles = {{0, 0, 10, 10}};
  spec.file = "a.csv";
  const MapParts parts = read_map_parts(spec, folder / "");
  EXPECT_EQ(parts.walls.size(), 2u);
  EXPECT_EQ(parts.bounds.hi, (Vec2{30, 10}));
  spec.lo = Vec2{-5, -5};
  spec.hi = Vec2{50, 50};
  EXPECT_EQ(read_map_parts(spec, folder / "").bounds.lo, (Vec2{-5, -5}));
}

TEST(MapFile, SettingsChooseHowAFileIsRead) {
  const Folder folder;
  Image dark{3, 1, 1, {10, 200, 10}};
  folder.with("a.pgm", encode_pnm(dark));
  const auto walls = [&](std::initializer_list<std::string> settings) {
    return read_map_parts(choose_map_spec(folder / "a.pgm", {.um_per_px = 1, .settings = settings}))
        .walls.size();
  };
  EXPECT_EQ(walls({}), 2u);
  EXPECT_EQ(walls({"map.free=dark"}), 1u);
  EXPECT_EQ(walls({"map.threshold=5"}), 0u);
  const auto spec = choose_map_spec(folder / "a.pgm", {.settings = {"map.um_per_px=4"}});
  EXPECT_EQ(std::get<ImageMap>(spec).um_per_px, 4);
  EXPECT_TRUE(
      test::is_one_line_naming(error_of([&] { walls({"map.fre=dark"}); }), "map.fre", {"free"}));
  folder.with("walls", "0,0,2,1\n");
  EXPECT_TRUE(std::holds_alternative<RectanglesMap>(
      choose_map_spec(folder / "walls", {.settings = {"map.type=rectangles"}})));
  EXPECT_NE(error_of([&] {
              choose_map_spec(folder / "walls", {.settings = {"map.type=channel"}});
            }).find("map.type"),
            std::string::npos);
}

TEST(MapFile, AUnitScalesFilesInPlaneCoordinates) {
  const Folder folder;
  const auto bounds = [&](const char* name, std::string_view text) {
    return load_map(choose_map_spec(folder.with(name, text), {.um_per_unit = 1000}))
        .map->bounds()
        .hi;
  };
  EXPECT_EQ(bounds("a.csv", "0,0,2,1\n"), (Vec2{2000, 1000}));
  EXPECT_EQ(bounds("a.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[3,0],[3,2],[0,0]]]})"),
            (Vec2{3000, 2000}));
  folder.with("a.pgm", encode_pnm(corner_picture()));
  EXPECT_EQ(bounds("a.yaml", "image: a.pgm\nresolution: 2\norigin: [0, 0, 0]\n"),
            (Vec2{8000, 6000}));
  EXPECT_TRUE(test::is_one_line_naming(
      error_of([&] { choose_map_spec(folder / "a.pgm", {.um_per_unit = 5}); }),
      (folder / "a.pgm").string(), {"um_per_unit", "um_per_px"}));
  EXPECT_TRUE(test::is_one_line_naming(
      error_of([&] { choose_map_spec(folder / "a.geojson", {.um_per_px = 5}); }),
      (folder / "a.geojson").string(), {"um_per_unit", "um_per_px"}));
}

/// A picture that is all wall says what to change.
TEST(MapFile, PictureThatIsAllWallIsRefusedWithAdvice) {
  const Folder folder;
  folder.with("a.pgm", encode_pnm(Image{3, 1, 1, {0, 15, 9}}));
  const auto complaint = [&](FreePixels free, int threshold) {
    return error_of([&] {
      read_map_parts(ImageMap{.file = "a.pgm", .threshold = threshold, .free = free}, folder / "");
    });
  };
  EXPECT_TRUE(test::is_one_line_naming(complaint(FreePixels::bright, 128),
                                       (folder / "a.pgm").string(),
                                       {"15", "128", "map.threshold to 8", "map.free"}));
  folder.with("a.pgm", encode_pnm(Image{3, 1, 1, {40, 15, 19}}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(FreePixels::dark, 12), (folder / "a.pgm").string(),
                                       {"15", "12", "map.free"}));
}

/// What is read of a deep, a real or a stacked picture is told, and its grey is that of a
/// photograph.
TEST(MapFile, TellsWhatItTakesOfAPicture) {
  const Folder folder;
  const auto read = [&] { return load_map(guess_map_spec(folder / "a.tif", 1.0)); };
  using Notes = std::vector<std::string>;
  const std::string name = (folder / "a.tif").string();
  test::write_tiff<std::uint16_t>(folder / "a.tif", 3, {{4095, 100, 4000}});
  LoadedMap loaded = read();
  EXPECT_TRUE(loaded.map->is_free(Vec2{0.5, 0.5}, 0.1));
  EXPECT_FALSE(loaded.map->is_free(Vec2{1.5, 0.5}, 0.1));
  EXPECT_EQ(loaded.notes,
            (Notes{name + ": its 16-bit samples are read as numbers of 12 bits: 4095 is white"}));
  test::write_tiff<float>(folder / "a.tif", 3, {{0.25F, 1.0F, 0.5F}, {1, 1, 1}},
                          {.format = SAMPLEFORMAT_IEEEFP});
  loaded = read();
  EXPECT_FALSE(loaded.map->is_free(Vec2{0.5, 0.5}, 0.1));
  EXPECT_TRUE(loaded.map->is_free(Vec2{1.5, 0.5}, 0.1));
  ASSERT_EQ(loaded.notes.size(), 2u);
  EXPECT_EQ(loaded.notes[0], name + ": holds 2 pictures, the first is taken");
  EXPECT_NE(loaded.notes[1].find("0.25 is black, 1 is white"), std::string::npos)
      << loaded.notes[1];
}

TEST(MapFile, AScaleIsGivenOnce) {
  const Folder folder;
  folder.with("a.geojson", "{}");
  folder.with("a.pgm", encode_pnm(Image{3, 1, 1, {0, 255, 9}}));
  const auto complaint = [&](const char* file, MapChoice choice) {
    return error_of([&] { choose_map_spec(folder / file, choice); });
  };
  EXPECT_TRUE(test::is_one_line_naming(
      complaint("a.geojson", {.um_per_unit = 5, .settings = {"map.um_per_unit=3"}}),
      (folder / "a.geojson").string(), {"um_per_unit", "map.um_per_unit"}));
  EXPECT_TRUE(test::is_one_line_naming(
      complaint("a.pgm", {.um_per_px = 5, .settings = {"map.um_per_px=5"}}),
      (folder / "a.pgm").string(), {"um_per_px", "map.um_per_px"}));
}

TEST(MapFile, WhatMakesAMapOfAFileIsTold) {
  const Folder folder;
  const auto ends_with = [&](const char* file, const std::string& advice) {
    folder.with(file, "");
    const std::string said = error_of([&] { choose_map_spec(folder / file, {}); });
    EXPECT_TRUE(said.ends_with(" or SVG" + advice)) << said;
  };
  ends_with("a.docx", "");
  ends_with("a.dxf", "; export the drawing as SVG");
  ends_with("a.svgz", "; unpack it: gunzip < a.svgz > a.svg");
  ends_with("a.geojson.gz", "; unpack it: gunzip < a.geojson.gz > a.geojson");
}

/// Walls beyond stated bounds are told; those that only reach beyond them are not.
TEST(MapFile, WallsOutsideOfTheirBoundsAreTold) {
  const Folder folder;
  const auto notes = [&](const std::string& box) {
    folder.with("a.geojson", R"({"type":"FeatureCollection","um_per_unit":1,"bbox":[)" + box +
                                 R"(],"features":[
{"type":"Feature","properties":{"radius":2},"geometry":{"type":"Point","coordinates":[5,5]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
[[[20,20],[30,20],[30,40],[20,40],[20,20]]]}}]})");
    return read_map_parts(GeoJsonMap{.file = "a.geojson"}, folder / "").notes;
  };
  for (const char* box : {"0,0,50,50", "0,0,20,20", "4,4,25,30", "7,7,25,25"})
    EXPECT_TRUE(notes(box).empty()) << box;
  for (const char* wall : {"0,0,19,50", "0,0,50,19", "0,41,50,60", "31,0,60,50"})
    ASSERT_EQ(notes(wall).size(), 1u) << wall;
  const std::string one = notes("0,0,19,19")[0];
  EXPECT_NE(one.find("1 of 2 walls"), std::string::npos) << one;
  EXPECT_NE(one.find("0..19 × 0..19 µm, the first at (25, 30) µm"), std::string::npos) << one;
  EXPECT_NE(notes("100,100,120,120")[0].find("2 of 2 walls"), std::string::npos);
  const PolygonsMap listed{.lo = {0, 0}, .hi = {9, 9}, .discs = {{.centre = {12, 5}, .radius = 2}}};
  EXPECT_EQ(read_map_parts(listed).notes.size(), 1u);
}

TEST(MapFile, PolygonsAndDiscs) {
  PolygonsMap spec;
  spec.hi = {100, 50};
  spec.walls = {{{10, 10}, {10, 20}, {20, 20}}};
  spec.discs = {{{50, 25}, 5}};
  const LoadedMap map = load_map(spec);
  EXPECT_FALSE(map.map->is_free(Vec2{12, 18}, 0));
  EXPECT_EQ(map.map->clearance(Vec2{50, 35}), 5);
}

TEST(MapFile, ChannelIsCutIntoItsBlock) {
  ChannelMap spec;
  spec.width = 1000;
  spec.height = 400;
  spec.centre_line = {{200, 200}, {800, 200}};
  spec.half_width = spec.end_half_width = 100;
  const LoadedMap map = load_map(spec);
  EXPECT_EQ(map.map->bounds().hi, (Vec2{1000, 400}));
  EXPECT_TRUE(map.map->is_free(Segment{{250, 200}, {750, 200}}, 95));
  EXPECT_FALSE(map.map->is_free(Vec2{500, 310}, 0));
  EXPECT_NEAR(map.map->clearance(Vec2{500, 200}), 100, 1);
}

TEST(MapFile, FingerprintFollowsTheMapNotTheFile) {
  RectanglesMap a;
  a.rectangles = {{0, 0, 10, 10}};
  PolygonsMap b;
  b.hi = {10, 10};
  b.walls = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  EXPECT_EQ(load_map(a).input_hash, load_map(b).input_hash);
  b.walls[0][2].x = 9;
  EXPECT_NE(load_map(a).input_hash, load_map(b).input_hash);
}

TEST(MapFileErrors, OneLineEach) {
  PolygonsMap flat;
  EXPECT_EQ(error_of([&] { load_map(flat); }), "map: the map's bounds are empty: 0..0 × 0..0 µm");
  flat.hi = {1, 1};
  flat.walls = {{{0, 0}, {1, 1}}};
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { load_map(flat); }), "map.walls_um[0]",
                                       {"3", "points", "area"}));
  flat.walls = {{{0, 0}, {1e10, 0}, {0, 1}}};
  EXPECT_TRUE(
      test::is_one_line_naming(error_of([&] { load_map(flat); }), "map", {"1e10 µm", "1e9"}));
  flat.walls = {{{0, 0}, {std::nan(""), 0}, {0, 1}}};
  EXPECT_TRUE(
      test::is_one_line_naming(error_of([&] { load_map(flat); }), "map", {"nan µm", "1e9"}));
  RectanglesMap boxes;
  boxes.rectangles = {{1, 2, 3}};
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { load_map(boxes); }), "map.rectangles_um[0]",
                                       {"3", "numbers", "4", "width"}));
  boxes.rectangles = {{1, 2, 3, -4}};
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { load_map(boxes); }), "map.rectangles_um[0]",
                                       {"width", "3", "height", "-4 µm", "0"}));
  boxes.rectangles.clear();
  EXPECT_NE(error_of([&] { load_map(boxes); }).find("bounds are empty"), std::string::npos);
  EXPECT_TRUE(
      test::is_one_line_naming(error_of([] { parse_rectangles("0,0,1,1\n0 0 1 x\n", "x.csv"); }),
                               "x.csv:2", {"x", "number"}));
  EXPECT_TRUE(test::is_one_line_naming(error_of([] { parse_rectangles("a,b\n", "x.csv"); }),
                                       "x.csv:1", {"rectangles", "x,y,width,height"}));
}

TEST(GuessMapSpec, ByExtension) {
  const Folder folder;
  const auto at = [&](std::string_view name) { return folder.with(name, "x"); };
  const auto picture = std::get<ImageMap>(guess_map_spec(at("a.PNG"), 2.5));
  EXPECT_EQ(picture.um_per_px, 2.5);
  EXPECT_EQ(picture.file, (folder / "a.PNG").string());
  EXPECT_EQ(std::get<MovingAiMap>(guess_map_spec(at("a.map"), 4)).um_per_cell, 4);
  EXPECT_EQ(std::get<MovingAiMap>(guess_map_spec(at("a.map"))).um_per_cell, 1);
  EXPECT_TRUE(std::holds_alternative<GeoJsonMap>(guess_map_spec(at("a.geojson"))));
  EXPECT_TRUE(std::holds_alternative<GeoJsonMap>(guess_map_spec(at("a.json"))));
  EXPECT_TRUE(std::holds_alternative<RectanglesMap>(guess_map_spec(at("a.txt"))));
  const auto yaml = folder.with("m.yaml", "image: a.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  EXPECT_EQ(std::get<RosMap>(guess_map_spec(yaml)).um_per_m, 1e6);
  EXPECT_EQ(std::get<RosMap>(guess_map_spec(yaml, 5)).um_per_m, 10);
}

TEST(GuessMapSpec, EveryPictureIsAMap) {
  const Folder folder;
  for (const std::string_view extension : image_extensions) {
    const auto file = folder.with("a" + std::string(extension), encode_pnm(corner_picture()));
    EXPECT_TRUE(has_image_extension(file));
    EXPECT_EQ(load_map(guess_map_spec(file, 10)).map->bounds().hi, (Vec2{40, 30})) << extension;
  }
  EXPECT_FALSE(has_image_extension("a.gif"));
}

TEST(GuessMapSpec, EveryFormatIsNamedAndRead) {
  const Folder folder;
  const std::string named = map_formats();
  EXPECT_NE(error_of([&] { guess_map_spec(folder.with("x.doc", "")); }).find(named),
            std::string::npos);
  for (const char* name : {"picture", "ROS", "MovingAI", "GeoJSON", "CSV"})
    EXPECT_NE(named.find(name), std::string::npos) << named;
}

TEST(GuessMapSpec, DrawingsOfCadAreToBeExported) {
  const Folder folder;
  const auto file = folder.with("x.DXF", "");
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { guess_map_spec(file); }), file.string(),
                                       {"SVG", "export"}));
}

TEST(GuessMapSpec, SaysWhatIsMissing) {
  const Folder folder;
  const auto complaint = [&](std::string_view name, std::optional<double> um_per_px = {}) {
    const std::string what = error_of([&] { guess_map_spec(folder / name, um_per_px); });
    return what.substr(std::min(what.size(), (folder / "").string().size()));
  };
  for (const char* name : {"x.png", "x.csv", "x.doc", "x.yaml"}) folder.with(name, "a: 1\n");
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.png"), "x.png", {"missing", "um_per_px"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.png", -1), "x.png", {"-1", "1e-6..1e6"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.csv", 2), "x.csv", {"pixels", "um_per_px"}));
  EXPECT_EQ(complaint("no.png", 2), "no.png: cannot read: No such file or directory");
  EXPECT_TRUE(
      test::is_one_line_naming(complaint("x.doc"), "x.doc", {"ROS", "MovingAI", "GeoJSON"}));
  EXPECT_EQ(complaint("x.yaml").substr(0, 9), "x.yaml:1:");
}

}  // namespace
}  // namespace microswarm::formats
