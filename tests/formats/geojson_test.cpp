// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/geojson.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/json_place.hpp"
#include "microswarm/formats/thick_line.hpp"
#include "microswarm/world/map/map.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;

MapParts parsed_geojson(std::string_view text, std::optional<double> scale = {}) {
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

TEST(GeoJson, OneFeatureIsTheBoundsByTrue) {
  for (const char* value : {"\"true\"", "1", "\"yes\"", "{}"})
    EXPECT_TRUE(test::is_one_line_naming(
        geojson_complaint(
            collection(feature(polygon(square), fmt::format(R"({{"bounds":{}}})", value)))),
        "x.geojson:3", {"bounds", "true or false"}))
        << value;
  for (const char* value : {"false", "null"})
    EXPECT_EQ(parsed_geojson(
                  collection(feature(polygon(square), fmt::format(R"({{"bounds":{}}})", value))))
                  .walls.size(),
              1u);
  const std::string bounds = feature(polygon(square), R"({"bounds":true})");
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(collection(bounds + ",\n" + bounds)),
                                       "x.geojson:4", {"features[1]", "second", "bounds"}));
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
    const Vec2 p = point();
    const double a = rng.uniform(1e-3, 100);
    Polygon wall{{p, p + Vec2{a, 0}, p + Vec2{a, a}, p + Vec2{0, a}},
                 {{p + Vec2{a / 3, a / 7}, p + Vec2{a / 2, a / 3}, p + Vec2{a / 5, a / 2}}}};
    parts.walls.push_back(normalised(std::move(wall)));
    parts.discs.push_back({point(), rng.uniform(1e-9, 1e6)});
  }
  parts.bounds = enclosing_box(parts);
  EXPECT_EQ(fingerprint(parsed_geojson(geojson_text(parts))), fingerprint(parts));
}

/// A polygon whose hole is `hole`, in a ring from (0, 0) to (100, 100).
std::string with_hole(std::string_view holes) {
  return polygon("[[[0,0],[100,0],[100,100],[0,100],[0,0]],\n" + std::string(holes) + "]");
}

TEST(GeoJsonErrors, HolesOutsideOrAcrossTheirRing) {
  const auto refused = [](std::string_view holes, int ring, std::string_view what) {
    return test::is_one_line_naming(geojson_complaint(with_hole(holes)), "x.geojson:2",
                                    {fmt::format("coordinates[{}]", ring), std::string(what)});
  };
  EXPECT_TRUE(refused("[[200,10],[210,10],[210,20],[200,10]]", 1, "outside"));
  EXPECT_TRUE(refused("[[50,50],[150,50],[150,60],[50,60],[50,50]]", 1, "crosses its ring"));
  EXPECT_TRUE(
      refused("[[10,10],[50,10],[50,50],[10,50],[10,10]],"
              "[[20,20],[30,20],[30,30],[20,20]]",
              2, "another hole"));
  EXPECT_TRUE(
      refused("[[10,10],[50,10],[50,50],[10,50],[10,10]],"
              "[[40,20],[60,20],[60,30],[40,20]]",
              2, "holes cross"));
  EXPECT_TRUE(refused("[[10,10],[50,50],[50,10],[10,50],[10,10]]", 1, "crosses itself"));
  // Through vertices on the ring, where no edges cross.
  EXPECT_TRUE(refused("[[50,40],[100,40],[150,50],[100,60],[50,60],[50,40]]", 1, "ring"));
}

/// Vertices that were computed to lie on an edge, and are beside it by rounding.
TEST(GeoJson, RingsThatTouchButForRoundingAreNoCrossing) {
  Rng rng(7, Purpose::test);
  for (int i = 0; i < 200; ++i) {
    const Vec2 a{rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4)};
    const Vec2 b{rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4)};
    const Vec2 c{rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4)};
    const double t = rng.uniform(0.1, 0.9);
    const Vec2 on = a + t * (b - a), in = 1.0 / 3 * (a + b + c);
    const Vec2 other = in + 0.2 * (c - in);
    const auto text = [](Vec2 p) { return "[" + number_text(p.x) + "," + number_text(p.y) + "]"; };
    const std::string outer = text(a) + "," + text(b) + "," + text(c) + "," + text(a);
    const std::string hole = text(on) + "," + text(in) + "," + text(other) + "," + text(on);
    const MapParts parts = parsed_geojson(polygon("[[" + outer + "],[" + hole + "]]"));
    EXPECT_EQ(parts.walls.size(), 1u) << i;
  }
}

TEST(GeoJson, HolesMayTouch) {
  for (const char* hole : {"[[50,50],[100,50],[50,60],[50,50]]",  // the ring, in a point
                           "[[0,0],[50,10],[10,50],[0,0]]",       // a corner
                           "[[10,10],[50,10],[50,50],[10,10]],[[50,50],[90,50],[90,90],[50,50]]"})
    EXPECT_EQ(parsed_geojson(with_hole(hole)).walls.size(), 1u) << hole;
}

/// What a crossing ring goes round is a wall, and the crossing is told, whether or not it is at a
/// vertex.
TEST(GeoJson, RingsThatCrossThemselvesAreTold) {
  const auto wall_area = [](const MapParts& parts) {
    double sum = 0;
    for (const Polygon& wall : parts.walls) sum += area(wall);
    return sum;
  };
  for (const char* ring : {"[[[400,0],[600,400],[600,0],[400,400],[400,0]]]",
                           "[[[400,0],[500,200],[600,400],[600,0],[500,200],[400,400],[400,0]]]"}) {
    const MapParts parts = parsed_geojson(polygon(ring));
    EXPECT_NEAR(wall_area(parts), 40'000, 1e-3) << ring;
    ASSERT_EQ(parts.notes.size(), 1u) << ring;
    EXPECT_TRUE(parts.notes[0].starts_with("x.geojson:1: coordinates[0]: ")) << parts.notes[0];
    EXPECT_NE(parts.notes[0].find("crosses itself at (500, 200)"), std::string::npos)
        << parts.notes[0];
  }
  const MapParts uneven =
      parsed_geojson(polygon("[[[400,0],[600,400],[600,100],[400,400],[400,0]]]"));
  EXPECT_EQ(uneven.notes.size(), 1u);
  EXPECT_EQ(uneven.walls.size(), 2u);
  // Two squares that touch in a corner, as traced pixels do.
  EXPECT_TRUE(parsed_geojson(polygon("[[[200,0],[300,0],[300,100],[400,100],[400,200],[300,200],"
                                     "[300,100],[200,100],[200,0]]]"))
                  .notes.empty());
}

TEST(GeoJson, LinesWithAWidthAreWalls) {
  const std::string line = R"({"type":"LineString","coordinates":[[0,0],[30,40],[30,100]]})";
  const MapParts parts = parsed_geojson(feature(line, R"({"width":10})"), 2);
  ASSERT_EQ(parts.walls.size(), 2u);
  EXPECT_NEAR(area(parts.walls[0]), 100 * 20, 1e-9);
  EXPECT_NEAR(area(parts.walls[1]), 120 * 20, 1e-9);
  ASSERT_EQ(parts.discs.size(), 3u);
  EXPECT_EQ(parts.discs[1].centre, (Vec2{60, 80}));
  EXPECT_EQ(parts.discs[1].radius, 10);
  const std::string lines =
      R"({"type":"MultiLineString","coordinates":[[[0,0],[1000,0]],[[0,9],[0,9],[900,9]]]})";
  const MapParts more = parse_geojson(lines, "x.geojson", std::nullopt, 4);
  EXPECT_EQ(more.walls.size(), 2u);
  EXPECT_EQ(more.bounds.lo, (Vec2{-2, -2}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(feature(line)), "x.geojson:1",
                                       {"LineString", "'width'", "line_width_um"}));
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(feature(line, R"({"width":0})")),
                                       "x.geojson:1", {"properties.width", "0 µm"}));
}

TEST(GeoJson, UnitsAreToldOrAskedFor) {
  const auto notes = [](std::string_view ring, std::optional<double> unit = {}) {
    return parse_geojson(polygon(ring), "x.geojson", unit).notes;
  };
  const char* degrees = "[[[8.54,47.37],[8.55,47.37],[8.55,47.38],[8.54,47.37]]]";
  ASSERT_EQ(notes(degrees).size(), 1u);
  EXPECT_NE(notes(degrees)[0].find("um_per_unit"), std::string::npos);
  EXPECT_TRUE(notes(degrees, 1).empty());
  EXPECT_TRUE(notes("[[[0,0],[200,0],[200,90],[0,0]]]").empty());
  const char* country = "[[[458000,5500000],[458100,5500000],[458100,5500100],[458000,5500000]]]";
  ASSERT_EQ(notes(country).size(), 1u);
  EXPECT_NE(notes(country)[0].find("metres"), std::string::npos);

  const std::string crs = R"({"type":"Feature","properties":{},"crs":{"type":"name","properties":)"
                          R"({"name":"EPSG:32633"}},"geometry":)" +
                          polygon(square) + "}";
  EXPECT_TRUE(test::is_one_line_naming(geojson_complaint(crs), "x.geojson:1",
                                       {"crs", "EPSG:32633", "um_per_unit"}));
  EXPECT_EQ(parsed_geojson(crs, 1e6).bounds.hi, (Vec2{4e6, 4e6}));
  const std::string own =
      R"({"type":"Polygon","um_per_unit":3,"crs":null,"coordinates":)" + std::string(square) + "}";
  EXPECT_EQ(parse_geojson(own, "x.geojson").bounds.hi, (Vec2{12, 12}));
  EXPECT_TRUE(parse_geojson(own, "x.geojson").notes.empty());
  MapParts small{{{0, 0}, {5, 5}}, {}, {}};
  EXPECT_TRUE(parse_geojson(geojson_text(small), "x.geojson").notes.empty());
}

TEST(GeoJsonErrors, OtherJsonOfMapsIsNamed) {
  for (const auto& [text, name] :
       {std::pair{R"({"type":"Topology","objects":{},"arcs":[]})", "TopoJSON"},
        {R"({"type":"CityJSON","vertices":[]})", "CityJSON"},
        {R"({"geometryType":"esriGeometryPolygon","features":[]})", "Esri"}})
    EXPECT_TRUE(
        test::is_one_line_naming(geojson_complaint(text), "x.geojson:1", {name, "GeoJSON"}));
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

/// A traced line of thousands of points has the sides that it is drawn with, and few walls.
TEST(ThickLine, PointsThatSayNothingAreLeftOut) {
  std::vector<Vec2> arc;
  for (int i = 0; i <= 20'000; ++i) {
    const double angle = i * 1e-4;
    arc.push_back({100 * std::cos(angle), 100 * std::sin(angle)});
  }
  MapParts parts;
  add_thick_line(parts, arc, 10);
  EXPECT_LT(parts.walls.size(), 500u);
  const Map map({{-200, -200}, {200, 200}}, parts.walls, parts.discs);
  for (double angle = 0; angle < 2; angle += 0.0137)
    for (const double r : {90.0, 110.0})
      EXPECT_NEAR(map.clearance({r * std::cos(angle), r * std::sin(angle)}), 5, 0.01);
}

/// The sides are where they are drawn but for the rounding, however far apart the points are.
TEST(ThickLine, SidesMoveByNoMoreThanTheRounding) {
  constexpr double width = 10, radius = 100;
  for (const double step : {1e-4, 1e-3, 4e-3}) {
    std::vector<Vec2> arc;
    for (double angle = 0; angle <= 1; angle += step)
      arc.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    MapParts parts;
    add_thick_line(parts, arc, width);
    EXPECT_LT(2 * parts.walls.size(), arc.size()) << step;
    const Map map({{-200, -200}, {200, 200}}, parts.walls, parts.discs);
    for (double angle = 0.01; angle < 0.99; angle += 0.00137)
      for (const double r : {90.0, 110.0})
        EXPECT_NEAR(map.clearance({r * std::cos(angle), r * std::sin(angle)}), 5,
                    1.01 * thick_line_rounding * width)
            << step;
  }
}

/// A rectangle spans at most 64 segments, or long lines would take quadratic time.
TEST(ThickLine, StraightLinesAreSplit) {
  std::vector<Vec2> line;
  for (int i = 0; i <= 64 * 100; ++i) line.push_back({0.1 * i, 0});
  MapParts parts;
  add_thick_line(parts, line, 10);
  EXPECT_EQ(parts.walls.size(), 100u);
}

TEST(ThickLine, RepeatedPointsAreADisc) {
  MapParts parts;
  add_thick_line(parts, std::vector<Vec2>(3, Vec2{1, 2}), 10);
  EXPECT_TRUE(parts.walls.empty());
  ASSERT_EQ(parts.discs.size(), 1u);
  EXPECT_EQ(parts.discs[0].centre, (Vec2{1, 2}));
  EXPECT_EQ(parts.discs[0].radius, 5);
}

// A union of so many edges that cross does not end soon.
TEST(GeoJsonErrors, ARingThatCrossesItselfTooOften) {
  Rng rng(6, Purpose::test);
  std::string points;
  for (int k = 0; k < 60'000; ++k)
    points += fmt::format("[{:.4f},{:.4f}],", rng.uniform(0, 1e4), rng.uniform(0, 1e4));
  const std::string text =
      fmt::format(R"({{"type":"Polygon","coordinates":[[[0,0],{}[0,0]]]}})", points);
  EXPECT_TRUE(
      test::is_one_line_naming(geojson_complaint(text), "x.geojson:1", {"60001 edges", "at most"}));
}

}  // namespace
}  // namespace microswarm::formats
