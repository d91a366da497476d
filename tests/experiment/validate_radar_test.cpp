// SPDX-License-Identifier: Apache-2.0
// What is refused of a radar's parameters, its route and its wait areas.
#include <gtest/gtest.h>

#include "microswarm/experiment/scenario/validate.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

/// A swarm of 40 µm in the open room, with a wall up to the middle and a valve of 400 µm beside it.
Scenario radar_room() {
  Scenario s = open_room();
  std::get<formats::PolygonsMap>(s.map).walls = {{{950, 0}, {1050, 0}, {1050, 450}, {950, 450}}};
  s.obstacles = {{Valve{.span = 400, .thickness = 40, .min_gap = 0, .max_gap = 300},
                  Still{.position = {1000, 700}}}};
  s.navigator = navigation::RadarParams{};
  return s;
}

navigation::RadarParams& radar(Scenario& s) {
  return std::get<navigation::RadarParams>(s.navigator);
}

std::string refusal(const Scenario& s) {
  return error_of([&] { KeyLocations("s.yaml").require_none(validate(s, world_of(s))); });
}

TEST(RadarCheck, StepsThatCouldLeapOverAWall) {
  Scenario s = radar_room();
  radar(s).detection_range = 200;
  radar(s).prediction_distance = 105;  // 2 · 40 + 25
  EXPECT_EQ(refusal(s), "");
  radar(s).prediction_distance = 106;
  EXPECT_EQ(refusal(s),
            "s.yaml: navigator.prediction_distance_um is 106, more than the swarm's least "
            "diameter + safety_distance_um, 105: it could step over a wall");
  s.swarm = VortexParams{.radius = 45, .moving_radius = 50, .radius_ripple = 5};  // 35 at least
  EXPECT_NE(refusal(s).find("safety_distance_um, 95"), std::string::npos) << refusal(s);
}

TEST(RadarCheck, WaypointsGivenAndPlanned) {
  Scenario s = radar_room();
  radar(s).waypoints = {{1000, 700}};
  radar(s).global_plan = true;
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml",
                                       {"navigator.global_plan", "navigator.waypoints_um"}));
}

TEST(RadarCheck, AsPublishedRefusesWhatIsNotThePapers) {
  Scenario s = radar_room();
  radar(s).as_published = true;
  EXPECT_EQ(refusal(s), "");
  radar(s).max_turn = radians(180);
  EXPECT_EQ(refusal(s), "");
  radar(s).max_turn = radians(120);
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml", {"max_turn_deg", "as_published"}));
  radar(s).max_turn = navigation::RadarParams{}.max_turn;
  radar(s).obstacle_speed_bound = 50;
  EXPECT_NE(refusal(s).find("obstacle_speed_bound_um_per_s"), std::string::npos) << refusal(s);
}

TEST(RadarCheck, FewerNodesThanSamples) {
  Scenario s = radar_room();
  radar(s).planner.samples = 500;
  radar(s).planner.max_nodes = 499;
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml",
                                       {"navigator.planner", "max_nodes", "499", "500"}));
  radar(s).planner.max_nodes = 500;
  EXPECT_EQ(refusal(s), "");
}

TEST(RadarCheck, LegsThroughAWall) {
  Scenario s = radar_room();
  radar(s).waypoints = {{900, 600}, {1100, 600}};
  EXPECT_EQ(refusal(s), "");
  radar(s).waypoints = {{900, 600}, {1100, 200}, {1200, 600}};
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml",
                                       {"waypoint 1", "900", "600", "waypoint 2", "1100", "200"}));
  radar(s).waypoints = {{1100, 300}};
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml",
                                       {"start", "200", "500", "waypoint 1", "1100", "300"}));
  radar(s).waypoints = {{900, 300}};
  EXPECT_TRUE(test::is_one_line_naming(refusal(s), "s.yaml",
                                       {"waypoint 1", "900", "300", "goal", "1800", "500"}));
  radar(s).waypoints.clear();  // then it is the navigator's to find one
  EXPECT_EQ(refusal(s), "");
}

/// A room that a lane of this width and 400 µm length connects with the goal's.
Scenario lane(double width) {
  Scenario s = open_room();
  std::get<formats::PolygonsMap>(s.map).walls = {
      {{800, 0}, {1200, 0}, {1200, 500 - width / 2}, {800, 500 - width / 2}},
      {{800, 500 + width / 2}, {1200, 500 + width / 2}, {1200, 1000}, {800, 1000}}};
  s.swarm = VortexParams{.radius = 40, .moving_radius = 40, .max_speed = 80};
  s.navigator = navigation::RadarParams{.speed = 80};
  return s;
}

TEST(RadarCheck, LanesThatItCannotEnterAreNamed) {
  EXPECT_TRUE(
      test::is_one_line_naming(refusal(lane(120)), "s.yaml",
                               {"navigator.safety_distance_um", "25", "65 µm", "60 µm", "500"}));
  Scenario s = lane(120);
  radar(s).safety_distance = 19;  // 59 of 60 µm
  EXPECT_EQ(refusal(s), "");
  for (const auto seed : {1u, 2u}) EXPECT_EQ(record_of(s, seed).result.status, Status::solved);
}

TEST(RadarCheck, NoLaneIsRefusedThatItPasses) {
  int passed = 0, refused = 0;
  for (const double thickness : {2.0, 20.0, 26.0, 400.0})
    for (int width = 118; width <= 134; width += 2) {
      Scenario s = lane(width);
      for (auto& wall : std::get<formats::PolygonsMap>(s.map).walls)
        for (Vec2& p : wall)
          if (p.x == 1200) p.x = 800 + thickness;
      radar(s).retreat = false;
      const bool is_refused = !refusal(s).empty();
      const bool arrives = record_of(s).result.status == Status::solved;
      EXPECT_FALSE(is_refused && arrives) << width << ' ' << thickness;
      passed += arrives;
      refused += is_refused;
    }
  EXPECT_GT(passed, 4);
  EXPECT_GT(refused, 4);
}

TEST(RadarCheck, StartsAndGoalsNearerToAWallAreAllowed) {
  Scenario s = open_room();
  s.navigator = navigation::RadarParams{};
  s.start->position = {200, 45};
  EXPECT_EQ(refusal(s), "");
  s = open_room();
  s.navigator = navigation::RadarParams{};
  s.goal = Vec2{1800, 45};
  EXPECT_EQ(refusal(s), "");
}

TEST(RadarCheck, WaitAreas) {
  Scenario s = radar_room();
  navigation::WaitZone area{.centre = {1000, 700}, .width = 300, .height = 300, .min_gap = 200};
  const auto why = [&] {
    radar(s).wait_zones = {area};
    return refusal(s);
  };
  EXPECT_EQ(why(), "");
  area.min_gap = 300;  // which it reaches for no time
  EXPECT_TRUE(test::is_one_line_naming(why(), "s.yaml",
                                       {"1", "min_gap_um", "300", "300 µm", "obstacle 1"}));
  area.min_gap = 200;
  area.centre = {1000, 500};
  EXPECT_TRUE(test::is_one_line_naming(why(), "s.yaml", {"zone", "1"}));
  area.centre = {1000, 1400};
  EXPECT_TRUE(test::is_one_line_naming(why(), "s.yaml", {"zone", "1", "1000", "1400"}));
}

TEST(RadarCheck, AValveThatIsDrawnInStopsNobody) {
  Scenario s = radar_room();
  std::get<Valve>(s.obstacles[0].shape).max_gap = 450;  // beyond its span
  radar(s).wait_zones = {{.centre = {1000, 700}, .width = 300, .height = 300, .min_gap = 460}};
  EXPECT_EQ(refusal(s), "");
}

}  // namespace
}  // namespace microswarm::experiment
