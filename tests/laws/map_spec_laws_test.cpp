// SPDX-License-Identifier: Apache-2.0
// Laws that every kind of map keeps, whatever it is read from.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/write_map.hpp"
#include "tests/laws/fields_laws.hpp"

namespace microswarm {
namespace {

/// A map with a free point and one in a wall; its file, where it has one, is written into a folder.
struct MapCase {
  std::string name;
  std::function<formats::MapSpec(const test::Folder&)> write;
  Vec2 free;
  Vec2 wall;
};

void PrintTo(const MapCase& c, std::ostream* os) { *os << c.name; }

/// The name of its file; null where there is none.
std::string* named_file(formats::MapSpec& spec) {
  std::string* const file = formats::file_name(spec);
  return file && !file->empty() ? file : nullptr;
}

class MapSpecLaws : public testing::TestWithParam<MapCase> {
 protected:
  test::Folder folder_;
  formats::MapSpec spec_ = GetParam().write(folder_);

  formats::LoadedMap load() const { return formats::load_map(spec_, folder_ / ""); }
  std::filesystem::path path() {
    const std::string* file = named_file(spec_);
    return file ? folder_ / *file : std::filesystem::path();
  }
};

TEST_P(MapSpecLaws, HasItsWallsWhereTheyAre) {
  const formats::LoadedMap loaded = load();
  const Map& map = *loaded.map;
  EXPECT_GT(map.bounds().width(), 0);
  EXPECT_GT(map.bounds().height(), 0);
  EXPECT_TRUE(map.bounds().contains(GetParam().free));
  EXPECT_TRUE(map.is_free(GetParam().free, 0));
  EXPECT_FALSE(map.is_free(GetParam().wall, 0));
  EXPECT_EQ(map.clearance(GetParam().wall), 0);
}

TEST_P(MapSpecLaws, ReadTwiceItIsTheSame) {
  EXPECT_EQ(load().input_hash, load().input_hash);
  const formats::MapParts parts = formats::read_map_parts(spec_, folder_ / "");
  EXPECT_EQ(formats::fingerprint(parts), load().input_hash);
}

TEST_P(MapSpecLaws, ClearanceIsThatOfThePartsRead) {
  const formats::MapParts parts = formats::read_map_parts(spec_, folder_ / "");
  const auto map = load().map;
  const Box& b = parts.bounds;
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    const double x = rng.uniform(b.lo.x, b.hi.x);
    const Vec2 p{x, rng.uniform(b.lo.y, b.hi.y)};
    double least = std::min({p.x - b.lo.x, b.hi.x - p.x, p.y - b.lo.y, b.hi.y - p.y});
    for (const Polygon& wall : parts.walls) least = std::min(least, distance(p, wall));
    for (const Disc& disc : parts.discs) least = std::min(least, distance(p, disc));
    ASSERT_NEAR(map->clearance(p), least, 1e-9 * b.width());
  }
}

// The keys read back, and what they name is the same map.
TEST_P(MapSpecLaws, ReadsBack) {
  laws::expect_reads_back(spec_);
  const std::string text = to_yaml(laws::Keyed<formats::MapSpec>{spec_});
  const auto again = read_yaml_text<laws::Keyed<formats::MapSpec>>(text, "law.yaml");
  EXPECT_EQ(formats::load_map(again.value, folder_ / "").input_hash, load().input_hash);
}

TEST_P(MapSpecLaws, WrittenExactlyItIsTheSameMap) {
  const formats::LoadedMap loaded = load();
  const Map& map = *loaded.map;
  formats::write_map(folder_ / "out.geojson", map);
  const formats::LoadedMap again =
      formats::load_map(formats::guess_map_spec(folder_ / "out.geojson"));
  EXPECT_EQ(formats::fingerprint(formats::to_parts(*again.map)),
            formats::fingerprint(formats::to_parts(map)));
}

TEST_P(MapSpecLaws, CellsSurviveEveryGridForm) {
  const formats::LoadedMap loaded = load();
  const Map& map = *loaded.map;
  const double cell = map.bounds().width() / 64;
  const formats::Mask cells = formats::rasterise(map, cell);
  for (const char* name : {"out.png", "out.map", "out.yaml"}) {
    formats::write_map(folder_ / name, map, cell);
    const formats::LoadedMap again =
        formats::load_map(formats::guess_map_spec(folder_ / name, cell));
    EXPECT_EQ(formats::rasterise(*again.map, cell), cells) << name;
  }
}

TEST_P(MapSpecLaws, GuessedFromItsFileItIsOfItsKind) {
  if (path().empty()) return;
  const bool is_picture = std::holds_alternative<formats::ImageMap>(spec_) ||
                          std::holds_alternative<formats::MatrixMap>(spec_);
  const formats::MapSpec guessed =
      formats::guess_map_spec(path(), is_picture ? std::optional<double>(10) : std::nullopt);
  EXPECT_EQ(guessed.index(), spec_.index());
}

TEST_P(MapSpecLaws, AFileThatIsNotThereIsNamed) {
  std::string* file = named_file(spec_);
  if (!file) return;
  *file = "none" + std::filesystem::path(*file).extension().string();
  const std::string what = test::error_of([&] { load(); });
  EXPECT_TRUE(test::is_one_line_naming(what, path().string(), {"cannot read"}));
}

// Cut off anywhere, or with a byte changed: a map, or lines that begin with the file's name.
TEST_P(MapSpecLaws, ADamagedFileIsReadOrNamed) {
  if (path().empty()) return;
  const std::string good = read_file(path());
  const auto expect_read_or_named = [&](const std::string& bytes) {
    std::ofstream(path(), std::ios::binary) << bytes;
    try {
      formats::read_map_parts(spec_, folder_ / "");
    } catch (const InputError& error) {
      std::istringstream lines(error.what());
      for (std::string line; std::getline(lines, line);)
        EXPECT_TRUE(line.starts_with((folder_ / "").string())) << line;
    }
  };
  Rng rng(2, Purpose::test);
  expect_read_or_named("");
  for (int i = 0; i < 100; ++i) {
    expect_read_or_named(good.substr(0, rng.below(good.size())));
    std::string bad = good;
    bad[rng.below(bad.size())] = static_cast<char>(rng.below(256));
    expect_read_or_named(bad);
  }
}

TEST_P(MapSpecLaws, LimitsAreKept) { EXPECT_GT(laws::expect_limits_are_kept(spec_), 0); }

/// 12 × 10 pixels: a bright room with dark walls.
formats::Image room_picture() {
  formats::Image image{12, 10, 1, std::vector<std::uint8_t>(120, 254)};
  for (int row = 2; row < 7; ++row)
    for (int column = 4; column < 6; ++column)
      image.pixels[static_cast<std::size_t>(12 * row + column)] = 0;
  image.pixels[119] = 0;
  return image;
}

std::vector<MapCase> map_cases() {
  const auto polygons = [](const test::Folder&) -> formats::MapSpec {
    formats::PolygonsMap spec;
    spec.hi = {200, 100};
    spec.walls = {{{10, 10}, {10, 40}, {60, 40}}, {{50, 30}, {90, 30}, {90, 60}}};
    spec.discs = {{{150, 50}, 20}};
    return spec;
  };
  const auto rectangles = [](const test::Folder&) -> formats::MapSpec {
    formats::RectanglesMap spec;
    spec.lo = Vec2{-10, -10};
    spec.hi = Vec2{100, 90};
    spec.rectangles = {{0, 0, 30, 10}, {20, 5, 10, 60}};
    return spec;
  };
  const auto rectangles_file = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.csv", "x_um,y_um,width_um,height_um\n0,0,30,10\n20,5,10,60\n70,0,5,70\n");
    formats::RectanglesMap spec;
    spec.file = "a.csv";
    return spec;
  };
  const auto channel = [](const test::Folder&) -> formats::MapSpec {
    formats::ChannelMap spec;
    spec.width = 1000;
    spec.height = 400;
    spec.centre_line = {{200, 150}, {500, 250}, {800, 200}};
    spec.half_width = spec.end_half_width = 90;
    return spec;
  };
  const auto image = [](const test::Folder& folder) -> formats::MapSpec {
    formats::write_png(folder / "a.png", room_picture());
    return formats::ImageMap{.file = "a.png", .um_per_px = 10};
  };
  const auto inverted = [](const test::Folder& folder) -> formats::MapSpec {
    formats::Image picture = room_picture();
    for (auto& p : picture.pixels) p = static_cast<std::uint8_t>(255 - p);
    folder.with("a.pgm", formats::encode_pnm(picture));
    return formats::ImageMap{
        .file = "a.pgm", .um_per_px = 10, .free = formats::FreePixels::dark, .simplify = 1};
  };
  const auto ros = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.pgm", formats::encode_pnm(room_picture()));
    folder.with("a.yaml", "image: a.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\n");
    return formats::RosMap{.file = "a.yaml", .um_per_m = 20};
  };
  const auto moving_ai = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.map", "type octile\nheight 3\nwidth 5\nmap\n.....\n.@@..\n...T.\n");
    return formats::MovingAiMap{.file = "a.map", .um_per_cell = 20};
  };
  const auto geojson = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.geojson",
                R"({"type":"FeatureCollection","bbox":[0,0,50,40],"features":[)"
                R"({"type":"Feature","properties":{"radius":5},"geometry":)"
                R"({"type":"Point","coordinates":[10,10]}},)"
                R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":)"
                R"([[[20,5],[40,5],[40,30],[20,5]]]}}]})");
    return formats::GeoJsonMap{.file = "a.geojson", .um_per_unit = 2};
  };
  const auto turned_ros = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.pgm", formats::encode_pnm(room_picture()));
    folder.with("a.yaml", "image: a.pgm\nresolution: 0.5\norigin: [-1, 2, 0.5]\n");
    return formats::RosMap{.file = "a.yaml", .um_per_m = 20};
  };
  const auto matrix = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.txt", "1 1 1 1 1\n1 0 0 1 1\n1 1 1 0 1\n");
    return formats::MatrixMap{.file = "a.txt", .um_per_cell = 20};
  };
  const auto svg = [](const test::Folder& folder) -> formats::MapSpec {
    folder.with("a.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 40">)"
                         R"(<circle cx="20" cy="20" r="8"/></svg>)");
    return formats::SvgMap{.file = "a.svg", .um_per_unit = 5, .um_per_px = 5};
  };
  return {{"Polygons", polygons, {100, 80}, {80, 45}},
          {"Rectangles", rectangles, {80, 40}, {25, 50}},
          {"RectanglesFile", rectangles_file, {50, 40}, {72, 50}},
          {"Channel", channel, {500, 250}, {500, 20}},
          {"Image", image, {15, 15}, {45, 55}},
          {"ImageDarkFree", inverted, {15, 15}, {45, 55}},
          {"Ros", ros, {-15, 45}, {25, 95}},
          {"RosTurned", turned_ros, {-8, 60}, {-2.5, 112}},
          {"Matrix", matrix, {10, 10}, {30, 30}},
          {"Svg", svg, {20, 20}, {100, 100}},
          {"MovingAi", moving_ai, {10, 10}, {30, 30}},
          {"GeoJson", geojson, {80, 70}, {70, 20}}};
}

INSTANTIATE_TEST_SUITE_P(All, MapSpecLaws, testing::ValuesIn(map_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm
