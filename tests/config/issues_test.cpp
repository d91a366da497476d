// SPDX-License-Identifier: Apache-2.0
// Each mistake as fields: its key, place, value and limit.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/config/yaml.hpp"
#include "tests/config/sample.hpp"
#include "tests/files.hpp"

namespace microswarm::sample {
namespace {

Issues issues_in(std::string_view text) {
  return test::issues_of([&] { read_yaml_text<Scene>(text, "s.yaml"); });
}

/// "KEY at PLACE is VALUE, LIMIT".
std::string shown(const Issue& issue) {
  return fmt::format("{} at {} is {}, {}", issue.keys.empty() ? "-" : issue.keys[0], issue.location,
                     issue.value, issue.limit);
}

std::string only(const Issues& issues) {
  return issues.size() == 1 ? shown(issues[0]) : fmt::format("{} issues", issues.size());
}

TEST(Issues, OfADocumentHaveTheWholeKey) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"seed: -1", "seed at s.yaml:1:7 is -1, at least 0"},
      {"planner: {step_um: 100_000}", "planner.step_um at s.yaml:1:20 is 100_000, a number"},
      {"planner: {step_um: 0.50}", "planner.step_um at s.yaml:1:20 is 0.50, 1..1e5 µm"},
      {"planner: {walls: slid}", "planner.walls at s.yaml:1:18 is slid, slide, stop"},
      {"planner: {stpe_um: 3}", "planner.stpe_um at s.yaml:1:11 is 3, step_um, max_nodes, walls"},
      {"second: {max_nodes: .inf}", "second.max_nodes at s.yaml:1:21 is .inf, a finite number"},
      {"count: 2147483648", "count at s.yaml:1:8 is 2147483648, at most 2147483647"},
      {"limit_s: [1, {a: 2}]", "limit_s at s.yaml:1:10 is [1, {a: 2}], a number"},
      {"goal_um: [1, -2e9]", "goal_um at s.yaml:1:14 is -2e9, -1e6..1e6 µm"},
      {"times_s: [1, 2, x]", "times_s.2 at s.yaml:1:17 is x, a number"},
      {"rings_um: [[], [[1, 2], 3]]", "rings_um.1.1 at s.yaml:1:25 is 3, [x, y]"},
      {"obstacles: [{shape: {type: nothing}}, {way_um: []}]",
       "obstacles.1.shape at s.yaml:1:39 is , "},
      {"obstacles: [{shape: {type: disc, radius_um: 0}}]",
       "obstacles.0.shape.radius_um at s.yaml:1:45 is 0, 0.001..1e6 µm"},
      {"tip: {type: fna}", "tip.type at s.yaml:1:13 is fna, disc, fan, nothing"},
      {"tip: {radius_um: 3}", "tip.type at s.yaml:1:6 is , disc, fan, nothing"},
      {"noisy: yes", "noisy at s.yaml:1:8 is yes, true or false"},
      {"name:\nseed: 1", "name at s.yaml:1:1 is , a text"},
      {"fast", "- at s.yaml:1:1 is fast, a mapping of keys"},
      {"seed: 1\nseed: 2", "- at s.yaml:2:1 is , "}};
  for (const auto& [text, expected] : cases) EXPECT_EQ(only(issues_in(text)), expected) << text;
}

TEST(Issues, AfterAMistakeInAVariantTheKeyIsRightAgain) {
  const Issues issues = issues_in(
      "tip: {type: fna}\nobstacles:\n  - shape: {type: x}\n  - shape: {type: disc, radius_um: -1, "
      "b: 2}\n    way_um: 7\nseed: a\n");
  std::string keys;
  for (const Issue& issue : issues) keys += issue.keys.at(0) + " ";
  EXPECT_EQ(keys,
            "tip.type obstacles.0.shape.type obstacles.1.shape.radius_um obstacles.1.shape.b "
            "obstacles.1.way_um seed ");
}

TEST(Issues, AThousandEndTheReading) {
  std::string entries = "times_s: [", keys;
  for (int i = 0; i < 5000; ++i) entries += "x, ";
  for (int i = 0; i < 5000; ++i) keys += fmt::format("k{}: 1\n", i);
  for (const std::string& text : {entries + "]\nseed: -1\n", keys}) {
    const Issues issues = issues_in(text);
    EXPECT_EQ(issues.size(), max_issues);
    const std::string told = to_string(issues);
    EXPECT_EQ(std::ranges::count(told, '\n'), 20);
    EXPECT_TRUE(told.ends_with("\nand at least 980 more")) << told;
  }
}

TEST(Issues, OfAnAssignmentHaveTheWholeKey) {
  const std::pair<Setting, std::string_view> cases[] = {
      {{"planner.step_um", "0"}, "planner.step_um at --set planner.step_um is 0, 1..1e5 µm"},
      {{"planner.stpe_um", "3"},
       "planner.stpe_um at --set planner.stpe_um is 3, step_um, max_nodes, walls"},
      {{"planer.step_um", "3"},
       "planer.step_um at --set planer.step_um is 3, name, seed, noisy, "
       "start, goal_um, planner, tip, limit_s, second, note, times_s, "
       "rings_um, obstacles, kinds, count"},
      {{"tip.type", "fna"}, "tip.type at --set tip.type is fna, disc, fan, nothing"},
      {{"obstacles.7.way_um", "[]"}, "obstacles.7.way_um at --set obstacles.7.way_um is [], "},
      {{"tip", "{type: fan, opening_deg: 999}"}, "tip.opening_deg at --set tip is 999, 0..360°"},
      {{"goal_um", "[1, 2"}, "goal_um at --set goal_um:1:1 is [1, 2, "},
      {{"seed.low", "3"}, "seed.low at --set seed.low is 3, "}};
  for (const auto& [setting, expected] : cases) {
    Scene scene;
    Notes notes;
    EXPECT_EQ(only(test::issues_of([&, one = setting] { set_value(scene, one, "--set", notes); })),
              expected);
    EXPECT_EQ(scene, Scene{});
  }
}

TEST(Issues, OfAnAssignmentWithoutAnOptionStandAtItsKey) {
  Scene scene;
  Notes notes;
  const Issues issues = test::issues_of([&] {
    set_value(scene, Setting{"planner.walls", "x"}, "", notes);
  });
  EXPECT_EQ(to_string(issues), "planner.walls: walls is 'x', allowed: slide, stop");
  EXPECT_EQ(to_string(test::issues_of([&] { Settings({"planner"}, ""); })),
            "'planner': must be KEY=VALUE");
}

TEST(Issues, OfDocumentAndAssignmentsComeTogether) {
  KeyLocations locations;
  Issues issues;
  read_yaml_text<Scene>("seed: -1\ntimes_s: [a]\n", "s.yaml",
                        Settings(std::vector<std::string>{"count=x", "nose=3"}, "--set"), locations,
                        issues);
  std::string found;
  for (const Issue& issue : issues) found += issue.keys.at(0) + " at " + issue.location + "; ";
  EXPECT_EQ(found,
            "seed at s.yaml:1:7; times_s.0 at s.yaml:2:11; count at --set count; nose at --set "
            "nose; ");
}

TEST(Settings, AreSplitAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_setting("name=a=b"), (Setting{"name", "a=b"}));
  EXPECT_EQ(to_string(Setting{"name", "a=b"}), "name=a=b");
  EXPECT_EQ(parse_setting("note="), (Setting{"note", ""}));
  EXPECT_THROW(parse_setting("=3"), InputError);
  Scene scene;  // given apart, a key is not split again
  Notes notes;
  EXPECT_EQ(test::issues_of([&] {
              set_value(scene, Setting{"name=a", "b"}, "", notes);
            }).size(),
            1u);
}

}  // namespace
}  // namespace microswarm::sample
