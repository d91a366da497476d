// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/passage.hpp"

#include <gtest/gtest.h>

#include "tests/world/random_worlds.hpp"

namespace microswarm {
namespace {

/// Two rooms of 900 × 1000 µm joined by a corridor of 200 µm length and the given width.
Drawn dumbbell(double width) {
  Drawn out;
  out.polygons = {rectangle(900, -10, 1100, 500 - width / 2),
                  rectangle(900, 500 + width / 2, 1100, 1010)};
  return out;
}

TEST(Passage, of_a_dumbbell_is_its_neck) {
  for (const double width : {100.0, 33.3, 12.0}) {
    const MapReport report = check_map(dumbbell(width).map());
    EXPECT_EQ(report.free_pieces, 1);
    EXPECT_EQ(report.wall_pieces, 2);
    EXPECT_NEAR(report.free_area, 2 * 900 * 1000 + 200 * width, 1e-6);
    ASSERT_EQ(report.passages.size(), 1u);
    EXPECT_NEAR(report.narrowest_passage, width, 1e-9);
    EXPECT_NEAR(report.passages[0].position.x, 1000, 110);
    EXPECT_NEAR(report.passages[0].position.y, 500, 1e-6);
    EXPECT_GE(report.widest, 900 - 0.003);  // it reaches a little into the neck
    EXPECT_LE(report.widest, 903);
  }
}

TEST(Passage, between_two_discs_is_where_they_are_nearest) {
  Drawn drawn;
  drawn.discs = {{{1000, 200}, 260}, {{1000, 850}, 310}};
  const MapReport report = check_map(drawn.map());
  ASSERT_EQ(report.passages.size(), 1u);
  EXPECT_NEAR(report.narrowest_passage, 650 - 570, 1e-6);
  EXPECT_NEAR(report.passages[0].position.y, 500, 0.1);
}

TEST(Passage, none_in_one_room) {
  const MapReport report = check_map(Drawn{}.map());
  EXPECT_TRUE(report.passages.empty());
  EXPECT_NEAR(report.widest, 1000, 0.003);
  EXPECT_EQ(report.narrowest_passage, report.widest);
  EXPECT_EQ(report.region_areas, std::vector<double>{2e6});
}

TEST(Passage, regions_are_counted_apart_however_thin_the_wall) {
  Drawn drawn;
  drawn.polygons = {rectangle(700, -1, 700.01, 1001)};
  const MapReport report = check_map(drawn.map());
  EXPECT_EQ(report.free_pieces, 2);
  ASSERT_EQ(report.region_areas.size(), 2u);
  EXPECT_NEAR(report.region_areas[0], 1299990, 1e-3);
  EXPECT_FALSE(widest_path(drawn.map(), {100, 500}, {1900, 500}).found);
}

TEST(Passage, a_map_that_is_all_wall) {
  Drawn drawn;
  drawn.polygons = {rectangle(-1, -1, 2001, 1001)};
  const MapReport report = check_map(drawn.map());
  EXPECT_EQ(report.free_pieces, 0);
  EXPECT_EQ(report.widest, 0);
  EXPECT_EQ(report.narrowest_passage, 0);
}

TEST(WidestPath, takes_the_wider_of_two_gaps_and_is_free_with_its_clearance) {
  Drawn drawn;
  drawn.polygons = {rectangle(950, -10, 1000, 200), rectangle(950, 280, 1000, 600),
                    rectangle(950, 720, 1000, 1010)};
  const Map map = drawn.map();
  const WidestPath way = widest_path(map, {300, 240}, {1700, 240});
  ASSERT_TRUE(way.found);
  EXPECT_LE(way.clearance, 60);
  EXPECT_GE(way.clearance, 60 - 1.5 * way.resolution);
  EXPECT_NEAR(way.tightest.y, 660, 10);
  EXPECT_EQ(way.path.front(), (Vec2{300, 240}));
  EXPECT_EQ(way.path.back(), (Vec2{1700, 240}));
  for (std::size_t i = 1; i < way.path.size(); ++i) {
    EXPECT_GE(drawn.clearance(Segment{way.path[i - 1], way.path[i]}), way.clearance);
  }
  EXPECT_NEAR(widest_path(map, {300, 240}, {1700, 240}, 30).clearance, 30, 1e-9);
}

TEST(WidestPath, is_tightest_within_a_long_edge) {
  const WidestPath way = widest_path(dumbbell(100).map(), {300, 500}, {1700, 500});
  EXPECT_NEAR(way.clearance, 50, 1e-9);
  EXPECT_EQ(way.path.size(), 2u);
  EXPECT_NEAR(way.tightest.x, 900, 2);  // where the neck begins
  EXPECT_NEAR(way.tightest.y, 500, 1e-9);
}

TEST(WidestPath, is_bounded_by_its_ends) {
  const Map map = Drawn{}.map();
  EXPECT_NEAR(widest_path(map, {7, 500}, {1990, 500}).clearance, 7, 1e-9);
  EXPECT_FALSE(widest_path(map, {-7, 500}, {1990, 500}).found);
  const WidestPath here = widest_path(map, {500, 500}, {500, 500});
  EXPECT_TRUE(here.found);
  EXPECT_NEAR(here.clearance, 500, 1e-9);
}

TEST(WidestPath, of_random_worlds_is_no_wider_than_the_ends_and_truly_free) {
  Rng rng(1, Purpose::test);
  for (int world = 0; world < 10; ++world) {
    const Drawn drawn = crowded(rng, 40, 20);
    const Map map = drawn.map();
    const Vec2 a = random_point(rng, drawn.bounds);
    const Vec2 b = random_point(rng, drawn.bounds);
    const WidestPath way = widest_path(map, a, b, 1e9, 20);
    if (!way.found) continue;
    EXPECT_LE(way.clearance, std::min(map.clearance(a), map.clearance(b)));
    for (std::size_t i = 1; i < way.path.size(); ++i) {
      EXPECT_TRUE(map.is_free(Segment{way.path[i - 1], way.path[i]}, way.clearance));
    }
  }
}

TEST(Connected, TellsRegionsApartWhateverTheResolution) {
  const Map thin({{0, 0}, {1000, 1000}},
                 {{{{500, 0}, {500.01, 0}, {500.01, 999.9}, {500, 999.9}}, {}}});
  EXPECT_TRUE(connected(thin, {100, 100}, {900, 100}));
  const Map closed({{0, 0}, {1000, 1000}},
                   {{{{500, 0}, {500.01, 0}, {500.01, 1000}, {500, 1000}}, {}}});
  EXPECT_FALSE(connected(closed, {100, 100}, {900, 100}));
  EXPECT_TRUE(connected(closed, {100, 100}, {100, 900}));
}

}  // namespace
}  // namespace microswarm
