// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/rectangles.hpp"
#include "tests/files.hpp"
#include "tests/formats/png.hpp"
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
  EXPECT_NE(error_of([&] { load_map(flat); }), "nothing was thrown");
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
                                       "x.csv", {"rectangles", "x,y,width,height"}));
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

TEST(GuessMapSpec, SaysWhatIsMissing) {
  const Folder folder;
  const auto complaint = [&](std::string_view name, std::optional<double> um_per_px = {}) {
    const std::string what = error_of([&] { guess_map_spec(folder / name, um_per_px); });
    return what.substr(std::min(what.size(), (folder / "").string().size()));
  };
  for (const char* name : {"x.png", "x.csv", "x.doc", "x.yaml"}) folder.with(name, "a: 1\n");
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.png"), "x.png", {"missing", "--um-per-px"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.png", -1), "x.png", {"-1", "1e-6..1e6"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("x.csv", 2), "x.csv", {"pixels", "--um-per-px"}));
  EXPECT_EQ(complaint("no.png", 2), "no.png: cannot read: No such file or directory");
  EXPECT_TRUE(
      test::is_one_line_naming(complaint("x.doc"), "x.doc", {"ROS", "MovingAI", "GeoJSON"}));
  EXPECT_EQ(complaint("x.yaml").substr(0, 9), "x.yaml:1:");
}

}  // namespace
}  // namespace microswarm::formats
