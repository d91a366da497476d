// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/svg_walls.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "microswarm/formats/map_file.hpp"
#include "microswarm/geometry/shapes.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

/// Walls of a 2 × 1 mm drawing with a square at its lower left, and what is noted.
LoadedMap load_drawing(const std::string& drawn, std::optional<double> um_per_px,
                       std::initializer_list<std::string> settings = {}) {
  const test::Folder folder;
  folder.with("a.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="2mm" height="1mm" )"
                       R"(viewBox="0 0 2000 1000"><rect x="40" y="40" width="300" height="300"/>)" +
                           drawn + "</svg>");
  return load_map(
      choose_map_spec(folder / "a.svg", {.um_per_px = um_per_px, .settings = settings}));
}

std::string line_drawing(double width, const char* path = "M1000 0 V1000",
                         const char* colour = "#000") {
  return fmt::format(R"(<path d="{}" stroke="{}" stroke-width="{}"/>)", path, colour, width);
}

/// Straight, slanted and crossing lines bar the way.
TEST(Svg, LinesThinnerThanAPixelAreWalls) {
  for (const double width : {9.0, 5.0, 2.0})
    for (const char* path :
         {"M1000 0 V1000", "M900 0 L1000 1000", "M1000 0 V1000 M900 0 L1100 1000"}) {
      const LoadedMap loaded = load_drawing(line_drawing(width, path), 10.0);
      for (double y = 100; y < 1000; y += 50)
        EXPECT_FALSE(loaded.map->is_free(Segment{{700, y}, {1300, y}}, 0)) << width << path << y;
      EXPECT_TRUE(loaded.map->is_free(Segment{{1300, 300}, {1300, 700}}, 150)) << width << path;
    }
  const LoadedMap half = load_drawing(line_drawing(5), 10.0);
  ASSERT_EQ(half.notes.size(), 1u);
  EXPECT_NE(half.notes[0].find("drawn with pixels of 5 µm"), std::string::npos) << half.notes[0];
}

/// The pixels in which a line between two columns of them is half of one at least.
TEST(Svg, PixelsAreNoFinerThanALineNeeds) {
  const auto pixels_of = [](const std::string& drawn) {
    const LoadedMap loaded = load_drawing(drawn, 10.0);
    return loaded.notes.empty() ? std::string() : loaded.notes[0];
  };
  for (const auto& [width, pixel] :
       {std::pair(7.0, "5"), {3.6, "2.5"}, {1.8, "1.25"}, {0.9, "0.625"}})
    EXPECT_NE(pixels_of(line_drawing(width)).find(fmt::format("drawn with pixels of {} µm", pixel)),
              std::string::npos)
        << width << ' ' << pixels_of(line_drawing(width));
  // A short line among long ones that are less thin.
  const std::string both = line_drawing(7) + line_drawing(0.9, "M1500 400 V500");
  EXPECT_NE(pixels_of(both).find("pixels of 0.625 µm"), std::string::npos) << pixels_of(both);
}

/// A line that closes a gap of eight pixels is a wall; a few dots need no finer pixels.
TEST(Svg, AFewDotsAreNoLine) {
  const std::string gap =
      R"(<rect x="600" y="0" width="300" height="460"/><rect x="600" y="540" width="300" )"
      R"(height="460"/>)";
  const LoadedMap closed = load_drawing(gap + line_drawing(3, "M755 450 V550"), 10.0);
  EXPECT_FALSE(closed.map->is_free(Segment{{500, 500}, {1300, 500}}, 0));
  EXPECT_TRUE(load_drawing(gap, 10.0).map->is_free(Segment{{500, 500}, {1300, 500}}, 30));
  std::string dots;
  for (int k = 0; k < 5; ++k)
    dots += fmt::format(R"(<circle cx="{}5" cy="505" r="2"/>)", 60 + 20 * k);
  const LoadedMap dotted = load_drawing(dots, 10.0);
  ASSERT_EQ(dotted.notes.size(), 1u);
  EXPECT_NE(dotted.notes[0].find("5 pixels with some ink are free"), std::string::npos)
      << dotted.notes[0];
}

/// Hatching that is finer than pixels looks like a pale fill.
TEST(Svg, HatchingIsAPaleFill) {
  std::string hatching;
  for (int x = 1000; x < 1400; x += 4)
    hatching += line_drawing(1, fmt::format("M{} 300 V700", x).c_str());
  const LoadedMap loaded = load_drawing(hatching, 10.0);
  EXPECT_TRUE(loaded.map->is_free(Segment{{900, 500}, {1500, 500}}, 30));
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("or pale fills"), std::string::npos) << loaded.notes[0];
}

TEST(Svg, WideLinesNeedNoFinerPixels) {
  EXPECT_TRUE(load_drawing(line_drawing(30), 10.0).notes.empty());
  EXPECT_TRUE(load_drawing("", 10.0).notes.empty());
}

/// Fills and lines that are paler than the threshold stay free, at the pixels that were asked for.
TEST(Svg, PaleInkIsFree) {
  const std::string fill = R"(<rect x="600" y="200" width="300" height="300" fill="#ff8"/>)";
  for (const std::string& pale : {fill, line_drawing(10, "M1000 0 V1000", "#ccc"),
                                  line_drawing(25, "M900 0 L1000 1000", "#ccc")}) {
    const LoadedMap loaded = load_drawing(pale, 10.0);
    EXPECT_TRUE(loaded.map->is_free(Segment{{700, 300}, {1300, 300}}, 0));
    ASSERT_EQ(loaded.notes.size(), 1u) << pale;
    EXPECT_NE(loaded.notes[0].find("a pixel of 10 µm, or pale fills"), std::string::npos)
        << loaded.notes[0];
  }
}

/// Where two channels meet within a pixel, the antialiased seam is no wall.
TEST(Svg, SeamsOfChannelsAreFree) {
  const LoadedMap loaded = load_drawing(R"(<rect x="100" y="403" width="904" height="200"/>)"
                                        R"(<rect x="1004" y="403" width="900" height="200"/>)",
                                        10.0, {"map.free=dark"});
  EXPECT_TRUE(loaded.map->is_free(Segment{{200, 500}, {1800, 500}}, 50));
}

/// Some that are too thin for a sixteenth of a pixel.
TEST(Svg, TellsLinesThatAreLost) {
  const LoadedMap hair = load_drawing(line_drawing(0.6), 10.0);
  ASSERT_EQ(hair.notes.size(), 1u);
  EXPECT_NE(hair.notes[0].find("thinner than a pixel of 10 µm"), std::string::npos)
      << hair.notes[0];
}

TEST(Svg, TellsDrawingsAndStyleSheetsOfOtherFiles) {
  for (const auto& [drawn, told] :
       {std::pair(R"(<use href="other.svg#x"/>)", "1 of its elements <use>"),
        {R"(<use x="1" xlink:href='other.svg#x' xmlns:xlink="http://www.w3.org/1999/xlink"/>)",
         "1 of its elements <use>"},
        {"<style>@import url(a.css);</style>", "1 of its style sheets"},
        {"<use href=\"#x\"/>", ""},
        {"<style>rect { fill: black }</style>", ""}}) {
    const LoadedMap loaded = load_drawing(drawn, 10.0);
    if (*told == 0) {
      EXPECT_TRUE(loaded.notes.empty()) << loaded.notes[0];
      continue;
    }
    ASSERT_EQ(loaded.notes.size(), 1u) << drawn;
    EXPECT_NE(loaded.notes[0].find(told), std::string::npos) << loaded.notes[0];
  }
  const test::Folder folder;
  const auto file = folder.with(
      "s.svg",
      "<?xml version=\"1.0\"?><?xml-stylesheet href=\"a.css\"?><svg "
      "xmlns=\"http://www.w3.org/2000/svg\" width=\"2mm\" height=\"1mm\"><rect width=\"1mm\" "
      "height=\"1mm\"/></svg>");
  const auto notes = load_map(choose_map_spec(file, {.um_per_px = 10})).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("1 of its style sheets"), std::string::npos);
}

/// As in a viewer; a blank before the unit is a slip.
TEST(Svg, ASideThatIsNotGivenFollows) {
  const test::Folder folder;
  for (const char* size : {"width=\"2mm\"", "height=\"1mm\"", "width=\"2 mm\" height=\"1 mm\"",
                           "width=' 2 mm '", "width='0.2 cm' height='1mm'"}) {
    const auto file = folder.with(
        "s.svg",
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" {} viewBox=\"0 0 20 10\"><rect "
                    "width=\"5\" height=\"5\"/></svg>",
                    size));
    const LoadedMap loaded = load_map(choose_map_spec(file, {.um_per_px = 10}));
    EXPECT_NEAR(loaded.map->bounds().hi.x, 2000, 1e-3) << size;
    EXPECT_NEAR(loaded.map->bounds().hi.y, 1000, 1e-3) << size;
    EXPECT_FALSE(loaded.map->is_free(Vec2{250, 750}, 0)) << size;
    EXPECT_TRUE(loaded.map->is_free(Vec2{750, 750}, 0)) << size;
  }
  const auto open = folder.with("s.svg",
                                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" "
                                "viewBox=\"0 0 20 10\"><rect width=\"5\" height=\"5\"/></svg>");
  EXPECT_NE(test::error_of([&] {
              load_map(choose_map_spec(open, {.um_per_px = 10}));
            }).find("its size is not in mm"),
            std::string::npos);
}

TEST(Svg, TellsPicturesOfOtherFiles) {
  const std::string link = R"(<image xlink:href="photo.png" width="10" height="10"/>)";
  const std::string xlink = R"(<g xmlns:xlink="http://www.w3.org/1999/xlink">)" + link + "</g>";
  const LoadedMap loaded = load_drawing(xlink, 10.0);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("1 of its pictures"), std::string::npos) << loaded.notes[0];
}

/// Units in mm, a transform, a circle, a stroke and a curve, in front of white.
TEST(Svg, IsWhatItLooksLike) {
  const test::Folder folder;
  folder.with("a.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="2mm" height="1mm" )"
                       R"(viewBox="0 0 200 100"><g transform='translate(100 0)'>)"
                       R"(<circle cx="50" cy="40" r="20"/></g>)"
                       R"(<path d="M10 80 H90" stroke="black" stroke-width="8" fill="none"/>)"
                       R"(<rect x="20" y="10" width="30" height="20" style="fill:#222"/>)"
                       R"(<rect x="60" y="10" width="10" height="10" fill="#fff"/></svg>)");
  const LoadedMap map = load_map(guess_map_spec(folder / "a.svg"));
  EXPECT_EQ(map.map->bounds().hi, (Vec2{2000, 1000}));
  ASSERT_EQ(map.notes.size(), 1u);
  EXPECT_NE(map.notes[0].find("give um_per_px"), std::string::npos) << map.notes[0];
  EXPECT_NEAR(map.map->clearance({1500, 300}), 100, 1);  // circle at (1500, 600), radius 200
  EXPECT_FALSE(map.map->is_free(Vec2{1500, 600}, 0));
  EXPECT_FALSE(map.map->is_free(Vec2{500, 200}, 0));  // the stroke, 80 wide
  EXPECT_NEAR(map.map->clearance({500, 300}), 60, 1);
  EXPECT_FALSE(map.map->is_free(Vec2{350, 800}, 0));  // the dark rectangle
  EXPECT_TRUE(map.map->is_free(Vec2{650, 850}, 0));   // the white one
  const LoadedMap scaled =
      load_map(choose_map_spec(folder / "a.svg", {.um_per_px = 2, .um_per_unit = 5}));
  EXPECT_EQ(scaled.map->bounds().hi, (Vec2{1000, 500}));
  EXPECT_NEAR(scaled.map->clearance({750, 150}), 50, 2);
  EXPECT_TRUE(scaled.notes.empty());
  folder.with("b.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100"/>)");
  EXPECT_TRUE(
      test::is_one_line_naming(test::error_of([&] { load_map(guess_map_spec(folder / "b.svg")); }),
                               (folder / "b.svg").string(), {"mm", "um_per_unit"}));
  folder.with("b.svg", "<svg");
  EXPECT_TRUE(
      test::is_one_line_naming(test::error_of([&] { load_map(guess_map_spec(folder / "b.svg")); }),
                               (folder / "b.svg").string(), {"SVG"}));
}

}  // namespace
}  // namespace microswarm::formats
