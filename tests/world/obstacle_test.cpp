// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/obstacle.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/world/world.hpp"
#include "tests/messages.hpp"

namespace microswarm {
namespace {

std::vector<Body> at(const Obstacle& obstacle, double t) {
  std::vector<Body> out;
  append_bodies(obstacle, 4, t, out);
  return out;
}

double distance_to(const std::vector<Body>& bodies, Vec2 p) {
  double least = 1e9;
  for (const Body& b : bodies) {
    least =
        std::min(least, std::visit([&](const auto& shape) { return distance(p, shape); }, b.shape));
  }
  return least;
}

const DeformingChannel channel{.centre_line = {{-800, 200}, {-300, -200}, {300, 200}, {800, -200}},
                               .half_width = 150,
                               .end_half_width = 200,
                               .end_length = 200,
                               .amplitude = 30,
                               .wavelength = 500,
                               .period = 12};

std::vector<Obstacle> all_obstacles() {
  const HarmonicArc arc{{0, 0}, 150, 0.3, 0.9, 7, 0};
  return {{DiscShape{30}, Straight{{0, 0}, {12, 5}}},
          {BreathingDisc{20, 90, 6, 0.1}, HarmonicLine{{0, 0}, {100, 50}, 11, 0}},
          {BoxShape{120, 30}, arc},
          {PolygonShape{{{0, 0}, {80, 10}, {20, 60}}}, arc},
          {Valve{300, 40, 20, 200, 8, 0}, Still{{50, 0}, 0.7}},
          {channel, Still{}}};
}

TEST(Obstacle, no_point_of_it_is_faster_than_its_top_speed) {
  Rng rng(1, Purpose::test);
  for (const Obstacle& obstacle : all_obstacles()) {
    const double top = top_speed(obstacle);
    for (int i = 0; i < 400; ++i) {
      const double t = rng.uniform(-5, 30);
      const double dt = std::pow(10.0, rng.uniform(-3, 0));
      const auto before = at(obstacle, t);
      const auto after = at(obstacle, t + dt);
      for (int k = 0; k < 5; ++k) {
        const Vec2 p{rng.uniform(-600, 600), rng.uniform(-400, 400)};
        EXPECT_LE(distance_to(before, p) - distance_to(after, p), top * dt + 1e-6);
      }
    }
  }
}

TEST(Obstacle, bodies_carry_their_number) {
  for (const Obstacle& obstacle : all_obstacles())
    for (const Body& body : at(obstacle, 3)) EXPECT_EQ(body.obstacle, 4u);
}

TEST(Obstacle, boxes_turn_with_their_heading) {
  const auto box = at({BoxShape{100, 20}, Still{{10, 20}, pi / 2}}, 0);
  ASSERT_EQ(box.size(), 1u);
  const Box bounds = bounding_box(std::get<Polygon>(box[0].shape));
  EXPECT_NEAR(bounds.width(), 20, 1e-12);
  EXPECT_NEAR(bounds.height(), 100, 1e-12);
  EXPECT_GT(signed_area(std::get<Polygon>(box[0].shape).outer), 0);
}

TEST(Obstacle, a_polygon_drawn_clockwise_is_solid_too) {
  const auto body = at({PolygonShape{{{0, 0}, {0, 50}, {50, 0}}}, Still{}}, 0);
  EXPECT_EQ(distance_to(body, {10, 10}), 0);
}

TEST(Obstacle, disc_breathes_between_its_radii) {
  const Obstacle disc{BreathingDisc{50, 100, 8, 0}, Still{}};
  auto radius = [&](double t) { return std::get<Disc>(at(disc, t)[0].shape).radius; };
  EXPECT_NEAR(radius(0), 75, 1e-12);
  EXPECT_NEAR(radius(2), 100, 1e-12);
  EXPECT_NEAR(radius(6), 50, 1e-12);
  EXPECT_NEAR(radius(6 + 8000), 50, 1e-9);
}

TEST(Obstacle, valve_leaves_leave_the_gap_and_fill_the_rest) {
  const Obstacle valve{Valve{400, 40, 0, 300, 20, 0}, Still{}};
  const auto open = at(valve, 5);  // widest: gap 300 across the heading
  ASSERT_EQ(open.size(), 2u);
  EXPECT_EQ(open[0].obstacle, open[1].obstacle);
  EXPECT_NEAR(distance_to(open, {0, 0}), 150, 1e-9);
  EXPECT_EQ(distance_to(open, {0, 199}), 0);
  EXPECT_NEAR(distance_to(open, {0, 201}), 1, 1e-9);
  EXPECT_EQ(distance_to(open, {20, -199}), 0);
  EXPECT_LT(distance_to(at(valve, 15), {0, 0}), 1e-9);
  EXPECT_TRUE(at({Valve{400, 40, 0, 500, 20, 0}, Still{}}, 5).empty());
}

TEST(Obstacle, is_absent_when_its_mover_is) { EXPECT_TRUE(at({DiscShape{5}, Track{}}, 0).empty()); }

TEST(Obstacle, what_makes_no_sense_is_named) {
  auto message = [](const Obstacle& o) -> std::string {
    const Issues issues = validate(o);
    EXPECT_LE(issues.size(), 1u);
    return issues.empty() ? "" : issues.begin()->text;
  };
  for (const Obstacle& o : all_obstacles()) EXPECT_EQ(message(o), "");
  EXPECT_EQ(message({BreathingDisc{90, 20}, Still{}}),
            "min_radius_um is 90, more than max_radius_um, 20");
  EXPECT_TRUE(test::is_one_line_naming(
      message({Valve{.span = 400, .min_gap = 300, .max_gap = 200}, Still{}}), "",
      {"min_gap_um", "300", "max_gap_um", "200"}));
  EXPECT_TRUE(test::is_one_line_naming(
      message({Valve{.span = 400, .min_gap = 500, .max_gap = 600}, Still{}}), "",
      {"min_gap_um", "500", "span_um", "400"}));
  EXPECT_TRUE(test::is_one_line_naming(message({PolygonShape{{{0, 0}, {1, 1}}}, Still{}}), "",
                                       {"vertices_um", "needs"}));
  EXPECT_TRUE(test::is_one_line_naming(message({PolygonShape{{{0, 0}, {1, 1}, {2, 2}}}, Still{}}),
                                       "", {"vertices_um", "area"}));
  EXPECT_TRUE(
      test::is_one_line_naming(message({DiscShape{5}, Waypoints{}}), "", {"points_um", "empty"}));
  EXPECT_TRUE(test::is_one_line_naming(message({DiscShape{5}, Track{"t.csv", "9", nullptr}}),
                                       "t.csv", {"samples", "9"}));
  const auto leap = std::make_shared<Samples>(Samples{{0, 2, 2}, {{0, 0}, {1, 1}, {2, 2}}});
  EXPECT_TRUE(test::is_one_line_naming(message({DiscShape{5}, Track{"t.csv", "9", leap}}), "t.csv",
                                       {"9", "2 s"}));
}

TEST(World, snapshots_hold_the_bodies_of_their_time) {
  World world{std::make_shared<Map>(Box{{-500, -500}, {500, 500}}, std::vector<Polygon>{}),
              {{DiscShape{30}, Straight{{0, 0}, {10, 0}}},
               {DiscShape{30}, Track{}},
               {Valve{.span = 100, .min_gap = 0, .max_gap = 50}, Still{}}}};
  const Snapshot now = world.at(7);
  EXPECT_EQ(now.time(), 7);
  ASSERT_EQ(now.moving().bodies().size(), 3u);
  EXPECT_EQ(std::get<Disc>(now.moving().bodies()[0].shape).centre, (Vec2{70, 0}));
  EXPECT_EQ(now.moving().bodies()[1].obstacle, 2u);
  EXPECT_EQ(&now.map(), world.map.get());
}

}  // namespace
}  // namespace microswarm
