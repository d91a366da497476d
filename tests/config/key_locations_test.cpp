// SPDX-License-Identifier: Apache-2.0
// Where a complaint that is made after reading begins.
#include "microswarm/config/key_locations.hpp"

#include <gtest/gtest.h>

namespace microswarm {
namespace {

KeyLocations keys(const std::vector<std::string>& assignments = {}) {
  const char* text =
      "name: a\n"
      "navigator:\n"
      "  type: radar\n"
      "  speed_um_per_s: 20\n"
      "  waypoints_um: [[1, 2],\n"
      "    [3, 4]]\n";
  return find_locations(parse_yaml(text, "a.yaml"), "a.yaml", {assignments, "--set"});
}

std::string said(const KeyLocations& at, std::string_view key) {
  return at.error(key, "no").what();
}

TEST(KeyLocations, AreOfTheValue) {
  EXPECT_EQ(said(keys(), "name"), "a.yaml:1:7: no");
  EXPECT_EQ(said(keys(), "navigator.speed_um_per_s"), "a.yaml:4:19: no");
  EXPECT_EQ(said(keys(), "navigator.waypoints_um.1"), "a.yaml:6:5: no");
}

TEST(KeyLocations, AKeyThatIsNotGivenStandsWhereItWould) {
  EXPECT_EQ(said(keys(), "navigator.planner.samples"), "a.yaml:3:3: no");
  EXPECT_EQ(said(keys(), "navigator.waypoints_um.2"), "a.yaml:5:17: no");
  EXPECT_EQ(said(keys(), "goal_um"), "a.yaml: no");
}

TEST(KeyLocations, OfSeveralKeysTheFirstThatIsGiven) {
  const auto line = [](std::vector<std::string> of, std::string text) {
    return to_string(keys().located(Issue{std::move(of), std::move(text)}));
  };
  EXPECT_EQ(line({"navigator.x", "navigator.speed_um_per_s"}, "no"), "a.yaml:4:19: no");
  EXPECT_EQ(line({"navigator.x", "y"}, "no"), "a.yaml:3:3: no");
  EXPECT_EQ(line({}, "b.csv:3: no"), "b.csv:3: no");
}

TEST(KeyLocations, WhatWasSetStandsThere) {
  const KeyLocations set = keys({"navigator.waypoints_um=[[5, 5]]", "name=b"});
  EXPECT_EQ(said(set, "name"), "--set name: no");
  EXPECT_EQ(said(set, "navigator.waypoints_um.0"), "--set navigator.waypoints_um: no");
  EXPECT_EQ(said(set, "navigator.speed_um_per_s"), "a.yaml:4:19: no");
  EXPECT_EQ(said(set, "navigator"), "--set navigator.waypoints_um: no");  // is a part of it
  EXPECT_EQ(said(set, "navigator.none"), "a.yaml:3:3: no");
  // Another type brings its own defaults; the same one changes nothing.
  EXPECT_EQ(said(keys({"navigator.type=safe_interval"}), "navigator.speed_um_per_s"),
            "--set navigator.type: no");
  EXPECT_EQ(said(keys({"navigator.type=radar"}), "navigator.speed_um_per_s"), "a.yaml:4:19: no");
}

TEST(KeyLocations, GivenIsWhatIsWrittenItself) {
  EXPECT_TRUE(keys().given("navigator.speed_um_per_s"));
  EXPECT_TRUE(given_within(keys().is_given(), "navigator")("waypoints_um"));
  EXPECT_FALSE(keys().given("navigator.retreat"));
  EXPECT_TRUE(keys({"navigator.retreat=true"}).given("navigator.retreat"));
  // Another type brings its own values.
  EXPECT_FALSE(keys({"navigator.type=safe_interval"}).given("navigator.speed_um_per_s"));
  EXPECT_TRUE(keys({"navigator.type=radar"}).given("navigator.speed_um_per_s"));
  EXPECT_FALSE(KeyLocations("a").given("x"));
  // A map brings the keys that it holds.
  const KeyLocations map = keys({"navigator={type: radar, retreat: true, guard: {active: true}}"});
  EXPECT_TRUE(map.given("navigator.retreat"));
  EXPECT_TRUE(map.given("navigator.guard.active"));
  EXPECT_FALSE(map.given("navigator.speed_um_per_s"));
  EXPECT_FALSE(map.given("navigator.guard.horizon_s"));
  // One without a type leaves the others as they were.
  const KeyLocations merged =
      keys({"navigator.guard.horizon_s=2", "navigator.guard={active: true}"});
  EXPECT_TRUE(merged.given("navigator.guard.horizon_s"));
  EXPECT_TRUE(merged.given("navigator.guard.active"));
}

TEST(KeyLocations, EveryIssueHasItsLine) {
  Issues inner;
  inner.add("speed_um_per_s", "no");
  inner.add({"x", "type"}, "no");
  Issues issues;
  issues.add_within("navigator", inner, "the navigator");
  issues.add("goal_um", "none");
  const auto told = [&](const KeyLocations& at) {
    try {
      at.require_none(issues);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(told(keys()),
            "a.yaml:4:19: the navigator: no\na.yaml:3:9: the navigator: no\na.yaml: none");
  EXPECT_EQ(told({}), "the navigator: no\nthe navigator: no\nnone");
  issues.drop({"navigator"});
  EXPECT_EQ(told("b"), "b: none");
  issues.drop({"goal_um"});
  EXPECT_EQ(told("b"), "");
}

}  // namespace
}  // namespace microswarm
