// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/write_map.hpp"
#include "microswarm/formats/choose_map_spec.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/formats/map_file.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;
using test::Folder;

Map round_and_square() {
  return {{{-10, 5}, {110, 95}},
          {{{{10, 10}, {50, 10}, {50, 50}, {10, 50}}, {{{20, 20}, {20, 30}, {30, 30}, {30, 20}}}},
           {{{0.1, 70}, {1.0 / 3, 80}, {-7.7, 75}}, {}}},
          {{{80, 60}, 12.345}}};
}

TEST(WriteMap, GeoJsonIsExact) {
  const Folder folder;
  const Map map = round_and_square();
  write_map(folder / "a.geojson", map);
  const LoadedMap again = load_map(GeoJsonMap{.file = "a.geojson"}, folder / "");
  EXPECT_EQ(fingerprint(to_parts(*again.map)), fingerprint(to_parts(map)));
  EXPECT_EQ(to_parts(map).walls.size(), 2u);
  EXPECT_EQ(to_parts(map).discs.size(), 1u);
}

TEST(WriteMap, CellsSurviveEveryGridForm) {
  const Folder folder;
  const Map map = round_and_square();
  const double cell = 2.5;
  const Mask cells = rasterise(map, cell);
  EXPECT_EQ(cells.width, 48);
  EXPECT_EQ(cells.height, 36);
  for (const char* name : {"a.png", "a.map", "a.yaml"}) {
    write_map(folder / name, map, cell);
    const LoadedMap again = load_map(guess_map_spec(folder / name, cell));
    EXPECT_EQ(rasterise(*again.map, cell), cells) << name;
    EXPECT_NEAR(again.map->bounds().width(), 120, 1e-9) << name;
  }
  const Box ros = load_map(guess_map_spec(folder / "a.yaml")).map->bounds();
  EXPECT_NEAR(ros.lo.x, -10, 1e-9);
  EXPECT_NEAR(ros.hi.y, 95, 1e-9);
}

TEST(WriteMap, ARosMapIsReadAgainAsItWas) {
  const Folder folder;
  Rng rng(6, Purpose::test);
  for (const char* name : {"a.yaml", "my map #1: \"x\".yaml", "-.yaml"}) {
    for (int trial = 0; trial < 20; ++trial) {
      Mask mask(2 + static_cast<int>(rng.below(30)), 2 + static_cast<int>(rng.below(30)));
      for (auto& cell : mask.cells) cell = rng.uniform() < 0.4;
      const double cell = rng.uniform(0.01, 20);
      const Vec2 lo{rng.uniform(-1e5, 1e5), rng.uniform(-1e5, 1e5)};
      const Map map(cell_bounds(mask, cell, lo), mask_walls(mask, cell, lo), {}, 2 * cell);
      write_map(folder / name, map, cell);
      const Map again = *load_map(guess_map_spec(folder / name)).map;
      EXPECT_EQ(rasterise(again, cell), mask) << name;
      EXPECT_NEAR(distance(again.bounds().lo, lo), 0, 1e-9) << name;
      EXPECT_NEAR(distance(again.bounds().hi, map.bounds().hi), 0, 1e-9) << name;
    }
  }
}

TEST(Rasterise, InvertsMaskWalls) {
  Rng rng(5, Purpose::test);
  for (int trial = 0; trial < 20; ++trial) {
    Mask mask(1 + static_cast<int>(rng.below(30)), 1 + static_cast<int>(rng.below(30)));
    for (auto& cell : mask.cells) cell = rng.uniform() < 0.4;
    const double cell = rng.uniform(0.01, 20);
    const Vec2 lo{rng.uniform(-100, 100), rng.uniform(-100, 100)};
    const Map map(cell_bounds(mask, cell, lo), mask_walls(mask, cell, lo), {}, 2 * cell);
    EXPECT_EQ(rasterise(map, cell), mask);
  }
}

TEST(Rasterise, WhatIsOutsideIsNotFree) {
  const Mask mask = rasterise(Map({{0, 0}, {10, 10}}, {}), 8);
  EXPECT_EQ(mask.width, 2);
  EXPECT_EQ(mask.cells, (std::vector<std::uint8_t>{1, 1, 0, 1}));
}

TEST(WriteMapErrors, OneLineEach) {
  const Folder folder;
  const Map map = round_and_square();
  const auto complaint = [&](std::string_view name, double cell) {
    const std::string what = error_of([&] { write_map(folder / name, map, cell); });
    return what.substr(std::min(what.size(), (folder / "").string().size()));
  };
  EXPECT_EQ(complaint("a.doc", 1),
            "a.doc: maps are written as .geojson, .png, .map (MovingAI) or .yaml (ROS)");
  EXPECT_TRUE(test::is_one_line_naming(complaint("a.png", 0), "a.png", {"missing", "cell"}));
  EXPECT_NE(error_of([&] { write_map(folder / "no/a.json", map); }).find("cannot write"),
            std::string::npos);
  EXPECT_TRUE(test::is_one_line_naming(error_of([&] { rasterise(map, 0.001); }), "",
                                       {"cells", "0.001 µm", "120000 × 90000", "16384"}));
  EXPECT_TRUE(
      test::is_one_line_naming(error_of([&] { rasterise(map, -1); }), "", {"cell", "-1 µm", "0"}));
}

}  // namespace
}  // namespace microswarm::formats
