// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/geojson.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/json_place.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;

MapParts parsed_geojson(std::string_view text, double scale = 1) {
  return parse_geojson(text, "x.geojson", scale);
}
std::string geojson_complaint(std::string_view text) {
  return error_of([&] { parsed_geojson(text); });
}

constexpr std::string_view square = R"([[[0,0],[4,0],[4,4],[0,4],[0,0]]])";

std::string polygon(std::string_view coordinates) {
  return R"({"type":"Polygon","coordinates":)" + std::string(coordinates) + "}";
}
std::string feature(std::string_view geometry, std::string_view properties = "{}") {
  return R"({"type":"Feature","properties":)" + std::string(properties) + R"(,"geometry":)" +
         std::string(geometry) + "}";
}
std::string collection(std::string_view features) {
  return "{\"type\":\"FeatureCollection\",\n\"features\":[\n" + std::string(features) + "]}";
}

TEST(GeoJson, PolygonsMultiPolygonsAndPointsWithRadius) {
  const MapParts parts = parsed_geojson(collection(
      feature(polygon(square)) + "," +
      feature(R"({"type":"MultiPolygon","coordinates":[)" + std::string(square) + "," +
              R"([[[9,9],[9,12],[12,12],[9,9]]])" + "]}") +
      "," + feature(R"({"type":"Point","coordinates":[20,5,99]})", R"({"radius":2})") + "," +
      feature(R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})", R"({"radius":1})") + "," +
      feature("null")));
  EXPECT_EQ(parts.walls.size(), 3u);
  for (const Polygon& wall : parts.walls) EXPECT_GT(signed_area(wall.outer), 0);
  EXPECT_EQ(parts.walls[0].outer.size(), 4u);
  ASSERT_EQ(parts.discs.size(), 3u);
  EXPECT_EQ(parts.discs[0].centre, (Vec2{20, 5}));
  EXPECT_EQ(parts.discs[0].radius, 2);
  EXPECT_EQ(parts.bounds.lo, (Vec2{0, 0}));
  EXPECT_EQ(parts.bounds.hi, (Vec2{22, 12}));
}

TEST(GeoJson, GeometryAloneAndCollections) {
  EXPECT_EQ(parsed_geojson(polygon(square)).walls.size(), 1u);
  EXPECT_EQ(
      parsed_geojson(R"({"type":"GeometryCollection","geometries":[)" + polygon(square) + "]}")
          .walls.size(),
      1u);
}

TEST(GeoJson, HolesTurnTheOtherWay) {
  const MapParts parts =
      parsed_geojson(polygon("[[[0,0],[0,9],[9,9],[9,0],[0,0]],[[1,1],[2,1],[2,2],[1,2],[1,1]]]"));
  ASSERT_EQ(parts.walls[0].holes.size(), 1u);
  EXPECT_GT(signed_area(parts.walls[0].outer), 0);
  EXPECT_LT(signed_area(parts.walls[0].holes[0]), 0);
  EXPECT_EQ(area(parts.walls[0]), 80);
}

TEST(GeoJson, BoundsByFeatureOrByBox) {
  const std::string wall = feature(polygon("[[[1,1],[2,1],[2,2],[1,1]]]"));
  const Box by_feature =
      parsed_geojson(collection(feature(polygon(square), R"({"bounds":true})") + "," + wall))
          .bounds;
  EXPECT_EQ(by_feature.lo, (Vec2{0, 0}));
  EXPECT_EQ(by_feature.hi, (Vec2{4, 4}));
  const Box by_box =
      parsed_geojson(R"({"type":"FeatureCollection","bbox":[-1,-2,5,6],"features":[)" + wall + "]}")
          .bounds;
  EXPECT_EQ(by_box.lo, (Vec2{-1, -2}));
  EXPECT_EQ(by_box.hi, (Vec2{5, 6}));
}

TEST(GeoJson, UnitsScaleEverything) {
  const MapParts parts = parsed_geojson(
      collection(feature(R"({"type":"Point","coordinates":[2,3]})", R"({"radius":1})") + "," +
                 feature(polygon(square), R"({"bounds":true})")),
      1000);
  EXPECT_EQ(parts.discs[0].centre, (Vec2{2000, 3000}));
  EXPECT_EQ(parts.discs[0].radius, 1000);
  EXPECT_EQ(parts.bounds.hi, (Vec2{4000, 4000}));
}

TEST(GeoJson, WrittenAndReadAgainGivesTheSameBits) {
  Rng rng(3, Purpose::test);
  const auto point = [&] { return Vec2{rng.uniform(0, 1000), 1e-3 * rng.normal()}; };
  MapParts parts;
  for (int i = 0; i < 50; ++i) {
    Polygon wall{{point(), point(), point(), point()}, {{point(), point(), point()}}};
    parts.walls.push_back(normalised(std::move(wall)));
    parts.discs.push_back({point(), rng.uniform(1e-9, 1e6)});
  }
  parts.bounds = enclosing_box(parts);
  EXPECT_EQ(fingerprint(parsed_geojson(geojson_text(parts))), fingerprint(parts));
}

TEST(GeoJsonErrors, NameLineAndPlace) {
  const std::string good = feature(polygon(square)) + ",\n";
  EXPECT_EQ(
      geojson_complaint(collection(good + feature(polygon("[[[0,0],[1,0],[\"a\",1],[0,0]]]")))),
      "x.geojson:4: features[1].geometry.coordinates[0][2][0]: a number expected, not string");
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(collection(good + feature(polygon("[[[0,0],\n[1,0],\n[3e9,1],[0,0]]]")))),
      "x.geojson:6", {"features[1].geometry.coordinates[0][2][0]", "3e9 µm", "1e9"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(collection(feature(polygon("[[[0],[1,0],[1,1],[0,0]]]")))), "x.geojson:3",
      {"features[0].geometry.coordinates[0][0]", "1", "2"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(
          collection(feature(R"({"type":"LineString","coordinates":[[0,0],[1,1]]})"))),
      "x.geojson:3", {"features[0].geometry.type", "LineString", "MultiPolygon", "MultiPoint"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(collection(feature(R"({"type":"Point","coordinates":[0,0]})"))),
      "x.geojson:3", {"features[0].geometry", "radius"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(
          collection(feature(R"({"type":"Point","coordinates":[0,0]})", R"({"radius":-1})"))),
      "x.geojson:3", {"features[0].properties.radius", "-1 µm", "0"}));
}

TEST(GeoJsonErrors, Rings) {
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(polygon("[[[0,0],[1,0],[0,0]]]")),
                                       "x.geojson:1", {"coordinates[0]", "3", "4"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(polygon("[[[0,0],[1,0],[1,1],[0,1]]]")),
                                       "x.geojson:1", {"coordinates[0]", "ring", "end"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(polygon("[[[0,0],[1,0],[2,0],[0,0]]]")),
                                       "x.geojson:1", {"coordinates[0]", "ring", "area"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(polygon("[]")), "x.geojson:1",
                                       {"polygon", "ring"}));
  EXPECT_EQ(geojson_complaint(polygon("7")),
            "x.geojson:1: coordinates: an array expected, not number");
}

TEST(GeoJsonErrors, Members) {
  EXPECT_EQ(geojson_complaint("[1]"), "x.geojson:1: an object expected, not array");
  EXPECT_TRUE(
      test::is_one_line_naming(geojson_complaint("{}"), "x.geojson:1", {"type", "missing"}));
  EXPECT_EQ(geojson_complaint(R"({"type":5})"), "x.geojson:1: type: a word expected");
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(R"({"type":"Polygon"})"), "x.geojson:1",
                                       {"coordinates", "missing"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(R"({"type":"Feature"})"), "x.geojson:1",
                                       {"geometry", "missing"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(collection("")), "x.geojson:1",
                                       {"walls", "discs", "bounds"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(R"({"type":"FeatureCollection","features":[],"bbox":[1,2,3]})"),
      "x.geojson:1", {"bbox", "3", "numbers", "4", "6"}));
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(
          collection(feature(polygon("[[[0,0],[1,0],[1,1],[0,0]]]"), R"({"bounds":true})"))),
      "x.geojson:3", {"features[0].geometry", "bounds", "rectangle"}));
}

TEST(GeoJsonErrors, NoJson) {
  EXPECT_TRUE(test::is_one_line_naming(
      geojson_complaint(polygon("[[[0,0],\n[NaN,0],[1,1],[0,0]]]")).substr(0, 23), "x.geojson:2",
      {"JSON"}));
  EXPECT_TRUE(
      test::is_one_line_naming(geojson_complaint("").substr(0, 23), "x.geojson:1", {"JSON"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint("\n\n{\"type\":").substr(0, 23),
                                       "x.geojson:3", {"JSON"}));
  EXPECT_NE(geojson_complaint(polygon("[[[1e999,0]]]")).find("1e999"), std::string::npos);
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(std::string(5000, '[')), "x.geojson",
                                       {"deeper", "32"}));
  EXPECT_NE(geojson_complaint("{\"\xff\":1}").find("not JSON"), std::string::npos);
}

TEST(JsonPlace, TextAndLine) {
  const std::string_view json = "{\n\"a\": \"x]}\\\"\",\n\"b\": [1,\n {\"c\":\n[[],{},7]}]}";
  const JsonPlace root;
  const JsonPlace b = root.member("b");
  const JsonPlace entry = b.entry(1);
  const JsonPlace c = entry.member("c");
  const JsonPlace seven = c.entry(2);
  const JsonPlace beyond = c.entry(3);
  EXPECT_EQ(seven.text(), "b[1].c[2]");
  EXPECT_EQ(line_number(json, root), 1);
  EXPECT_EQ(line_number(json, root.member("a")), 2);
  EXPECT_EQ(line_number(json, b), 3);
  EXPECT_EQ(line_number(json, entry), 4);
  EXPECT_EQ(line_number(json, seven), 5);
  EXPECT_EQ(line_number(json, beyond), 5);
  EXPECT_EQ(line_number(json, root.member("none")), 1);
}

}  // namespace
}  // namespace microswarm::formats
