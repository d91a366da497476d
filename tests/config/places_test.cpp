// SPDX-License-Identifier: Apache-2.0
// Where a complaint that is made after reading begins.
#include "microswarm/core/places.hpp"

#include <gtest/gtest.h>

#include "microswarm/config/yaml_places.hpp"

namespace microswarm {
namespace {

Places places(std::vector<std::string> assignments = {}) {
  const char* text =
      "name: a\n"
      "navigator:\n"
      "  type: radar\n"
      "  speed_um_per_s: 20\n"
      "  waypoints_um: [[1, 2],\n"
      "    [3, 4]]\n";
  return places_of(parse_yaml(text, "a.yaml"), "a.yaml", std::move(assignments));
}

std::string said(const Places& at, std::string_view key) { return at.error(key, "no").what(); }

TEST(Places, AreOfTheValue) {
  EXPECT_EQ(said(places(), "name"), "a.yaml:1:7: no");
  EXPECT_EQ(said(places(), "navigator.speed_um_per_s"), "a.yaml:4:19: no");
  EXPECT_EQ(said(places(), "navigator.waypoints_um.1"), "a.yaml:6:5: no");
}

TEST(Places, AKeyThatIsNotGivenStandsWhereItWould) {
  EXPECT_EQ(said(places(), "navigator.planner.samples"), "a.yaml:3:3: no");
  EXPECT_EQ(said(places(), "navigator.waypoints_um.2"), "a.yaml:5:17: no");
  EXPECT_EQ(said(places(), "goal_um"), "a.yaml: no");
}

TEST(Places, OfSeveralKeysTheFirstThatIsGiven) {
  EXPECT_STREQ(places().error({"navigator.x", "navigator.speed_um_per_s"}, "no").what(),
               "a.yaml:4:19: no");
  EXPECT_STREQ(places().error({"navigator.x", "y"}, "no").what(), "a.yaml:3:3: no");
}

TEST(Places, WhatWasSetStandsThere) {
  const Places set = places({"navigator.waypoints_um=[[5, 5]]", "name=b"});
  EXPECT_EQ(said(set, "name"), "--set name: no");
  EXPECT_EQ(said(set, "navigator.waypoints_um.0"), "--set navigator.waypoints_um: no");
  EXPECT_EQ(said(set, "navigator.speed_um_per_s"), "a.yaml:4:19: no");
  EXPECT_EQ(said(set, "navigator"), "--set navigator.waypoints_um: no");  // is a part of it
  EXPECT_EQ(said(set, "navigator.none"), "a.yaml:3:3: no");
  // Another type brings its own defaults; the same one changes nothing.
  EXPECT_EQ(said(places({"navigator.type=predictive"}), "navigator.speed_um_per_s"),
            "--set navigator.type: no");
  EXPECT_EQ(said(places({"navigator.type=radar"}), "navigator.speed_um_per_s"), "a.yaml:4:19: no");
}

TEST(Places, GivenIsWhatIsWrittenItself) {
  EXPECT_TRUE(places().given("navigator.speed_um_per_s"));
  EXPECT_TRUE(places().within("navigator").given("waypoints_um"));
  EXPECT_FALSE(places().given("navigator.retreat"));
  EXPECT_TRUE(places({"navigator.retreat=true"}).given("navigator.retreat"));
  // Another type brings its own values.
  EXPECT_FALSE(places({"navigator.type=predictive"}).given("navigator.speed_um_per_s"));
  EXPECT_TRUE(places({"navigator.type=radar"}).given("navigator.speed_um_per_s"));
  EXPECT_FALSE(Places("a").given("x"));
  // A map brings the keys that it holds.
  const Places map = places({"navigator={type: radar, retreat: true, guard: {active: true}}"});
  EXPECT_TRUE(map.given("navigator.retreat"));
  EXPECT_TRUE(map.given("navigator.guard.active"));
  EXPECT_FALSE(map.given("navigator.speed_um_per_s"));
  EXPECT_FALSE(map.given("navigator.guard.horizon_s"));
  // One without a type leaves the others as they were.
  const Places merged = places({"navigator.guard.horizon_s=2", "navigator.guard={active: true}"});
  EXPECT_TRUE(merged.given("navigator.guard.horizon_s"));
  EXPECT_TRUE(merged.given("navigator.guard.active"));
}

TEST(Places, WithinAKey) {
  const Places inner = places().within("navigator", "the navigator");
  EXPECT_EQ(said(inner, "speed_um_per_s"), "a.yaml:4:19: the navigator: no");
  EXPECT_EQ(said(inner.within("planner"), "samples"), "a.yaml:3:3: the navigator: no");
  EXPECT_EQ(said(Places("a").within("x", "y"), "z"), "a: y: no");
  EXPECT_EQ(said(Places().within("x", "y"), "z"), "y: no");
  EXPECT_EQ(said(Places(), "z"), "no");
}

}  // namespace
}  // namespace microswarm
