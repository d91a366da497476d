// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "microswarm/config/yaml.hpp"
#include "tests/config/message.hpp"
#include "tests/config/sample.hpp"
#include "tests/messages.hpp"

namespace microswarm::sample {
namespace {

Scene read(std::string_view text) { return read_yaml_text<Scene>(text, "s.yaml"); }
std::string complaint(std::string_view text) {
  return message_of([&] { read(text); });
}

TEST(Read, AnEmptyDocumentIsAllDefaults) {
  for (std::string_view text : {"", "\n", "# nothing\n", "---\n", "{}"})
    EXPECT_EQ(read(text), Scene{}) << text;
}

TEST(Read, EveryTypeOfField) {
  const Scene scene = read(R"(# a comment
name: vessel 3
seed: 18446744073709551615
noisy: true
start: {x_um: 1.5, y_um: -2, heading_deg: 90}
goal_um: [3e2, +4]
planner:
  step_um: 60
  walls: slide
tip:
  type: fan
  opening_deg: 45
limit_s: 0
second: {max_nodes: 1e3}
note: "60"
times_s: [0.5, 1]
rings_um:
  - [[0, 0], [1, 0], [0, 1]]
  - []
obstacles:
  - shape: {type: disc, radius_um: 7}
    way_um: [[1, 2]]
  - shape: {type: nothing}
kinds: [stop, slide, stop]
count: -12
)");
  EXPECT_EQ(scene.name, "vessel 3");
  EXPECT_EQ(scene.seed, ~0ULL);
  EXPECT_TRUE(scene.noisy);
  EXPECT_EQ(scene.start, (Pose2{{1.5, -2}, radians(90)}));
  EXPECT_EQ(scene.goal, (Vec2{300, 4}));
  EXPECT_EQ(scene.planner, (Planner{60, 4000, Walls::slide}));
  EXPECT_EQ(std::get<Fan>(scene.tip), (Fan{radians(45), 0}));
  EXPECT_EQ(scene.limit, 0.0);
  EXPECT_EQ(scene.second, (Planner{.max_nodes = 1000}));
  EXPECT_EQ(scene.note, "60");
  EXPECT_EQ(scene.times, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(scene.rings, (std::vector<std::vector<Vec2>>{{{0, 0}, {1, 0}, {0, 1}}, {}}));
  ASSERT_EQ(scene.obstacles.size(), 2u);
  EXPECT_EQ(scene.obstacles[0], (Obstacle{Disc{7}, {{1, 2}}}));
  EXPECT_EQ(scene.obstacles[1].shape, Shape{Nothing{}});
  EXPECT_EQ(scene.kinds, (std::vector{Walls::stop, Walls::slide, Walls::stop}));
  EXPECT_EQ(scene.count, -12);
}

TEST(Read, WhatIsNotGivenKeepsTheDefaultOfTheOuterStruct) {
  EXPECT_EQ(read("planner: {max_nodes: 5}").planner, (Planner{.step = 25, .max_nodes = 5}));
  EXPECT_EQ(read("note: null").note, std::nullopt);
  EXPECT_EQ(read("note: ~").note, std::nullopt);
  EXPECT_EQ(read("times_s: []\nkinds: []").kinds.size(), 0u);
}

TEST(Read, DegreesAreTheSameBitsAsInCode) {
  for (int d = -360; d <= 360; ++d)
    EXPECT_EQ(read("start: {heading_deg: " + std::to_string(d) + "}").start.heading, radians(d));
}

struct Case {
  std::string_view text, message;
};

TEST(Read, UnknownKeys) {
  const Case cases[] = {
      {"planner:\n  stpe_um: 3", "s.yaml:2:3: unknown key 'stpe_um', did you mean 'step_um'?"},
      {"planner:\n  step: 3", "s.yaml:2:3: unknown key 'step', did you mean 'step_um'?"},
      {"planner: {step_nm: 3}", "s.yaml:1:11: unknown key 'step_nm', did you mean 'step_um'?"},
      {"planner: {step_metres: 3}",
       "s.yaml:1:11: unknown key 'step_metres', did you mean 'step_um'?"},
      {"planner: {colour: red}",
       "s.yaml:1:11: unknown key 'colour', allowed: step_um, max_nodes, walls"},
      {"planner: {\"\": red}", "s.yaml:1:11: unknown key '', allowed: step_um, max_nodes, walls"},
      {"planner: {type: x}", "s.yaml:1:11: unknown key 'type', allowed: step_um, max_nodes, walls"},
      {"tip:\n  type: fan\n  radius_um: 3",
       "s.yaml:3:3: unknown key 'radius_um', allowed: type, opening_deg, turning_deg_per_s"},
      {"start: {heading_rad: 1}",
       "s.yaml:1:9: unknown key 'heading_rad', did you mean 'heading_deg'?"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
}

TEST(Read, MissingAndRepeatedKeys) {
  const Case cases[] = {
      {"obstacles:\n  - way_um: []", "s.yaml:2:5: missing key 'shape' in obstacles"},
      {"tip: {type: disc}", "s.yaml:1:6: missing key 'radius_um' in tip"},
      {"tip: {radius_um: 3}", "s.yaml:1:6: missing key 'type' in tip, allowed: disc, fan, nothing"},
      {"seed: 1\nname: a\nseed: 2", "s.yaml:3:1: key 'seed' given twice, first in line 1"},
      {"planner: {step_um: 1, step_um: 1}",
       "s.yaml:1:23: key 'step_um' given twice, first in line 1"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
  EXPECT_EQ(message_of([] { read_yaml_text<Disc>("", "d.yaml"); }),
            "d.yaml:1:1: missing key 'radius_um'");
}

TEST(Read, WrongTypes) {
  const Case cases[] = {
      {"limit_s: fast", "s.yaml:1:10: limit_s must be a number, not 'fast'"},
      {"limit_s: '60'", "s.yaml:1:10: limit_s must be a number, not the text '60'"},
      {"limit_s: [60]", "s.yaml:1:10: limit_s must be a number, not a list of 1"},
      {"limit_s: {a: 1}", "s.yaml:1:10: limit_s must be a number, not a mapping"},
      {"limit_s: 60 s", "s.yaml:1:10: limit_s must be a number, not '60 s'"},
      {"limit_s: 1_000", "s.yaml:1:10: limit_s must be a number, not '1_000'"},
      {"limit_s: 0x10", "s.yaml:1:10: limit_s must be a number, not '0x10'"},
      {"count: 1.5", "s.yaml:1:8: count must be a whole number, not '1.5'"},
      {"count: true", "s.yaml:1:8: count must be a whole number, not 'true'"},
      {"seed:", "s.yaml:1:1: seed must be a whole number, not empty"},
      {"noisy: yes", "s.yaml:1:8: noisy must be true or false, not 'yes'"},
      {"noisy: 1", "s.yaml:1:8: noisy must be true or false, not '1'"},
      {"name:\nseed: 1", "s.yaml:1:1: name must be a text, not empty"},
      {"name: [a]", "s.yaml:1:7: name must be a text, not a list of 1"},
      {"planner: fast", "s.yaml:1:10: planner must be a mapping of keys, not 'fast'"},
      {"planner:", "s.yaml:1:1: planner must be a mapping of keys, not empty"},
      {"start: [1, 2, 3]", "s.yaml:1:8: start must be a mapping of keys, not a list of 3"},
      {"tip: fan", "s.yaml:1:6: tip must be a mapping with the key 'type', not 'fan'"},
      {"times_s: 3", "s.yaml:1:10: times_s must be a list, not '3'"},
      {"times_s: [1, a]", "s.yaml:1:14: times_s must be a number, not 'a'"},
      {"rings_um: [[1, 2]]",
       "s.yaml:1:13: rings_um must be [x, y], not '1'\n"
       "s.yaml:1:16: rings_um must be [x, y], not '2'"},
      {"goal_um: 3", "s.yaml:1:10: goal_um must be [x, y], not '3'"},
      {"goal_um: [1, 2, 3]", "s.yaml:1:10: goal_um must be [x, y], not a list of 3"},
      {"goal_um: [1]", "s.yaml:1:10: goal_um must be [x, y], not a list of 1"},
      {"- 1", "s.yaml:1:1: the document must be a mapping of keys, not a list of 1"},
      {"fast", "s.yaml:1:1: the document must be a mapping of keys, not 'fast'"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
}

TEST(Read, TruthInTheSpellingsOfYaml) {
  for (const char* yes : {"true", "True", "TRUE"})
    EXPECT_TRUE(read_yaml_text<Scene>(std::string("noisy: ") + yes, "s.yaml").noisy) << yes;
  for (const char* no : {"false", "False", "FALSE"})
    EXPECT_FALSE(read_yaml_text<Scene>(std::string("noisy: ") + no, "s.yaml").noisy) << no;
  for (const char* none : {"tRUE", "\"True\"", "yes", "on"})
    EXPECT_NE(message_of([&] {
                read_yaml_text<Scene>(std::string("noisy: ") + none, "s.yaml");
              }).find("must be true or false"),
              std::string::npos)
        << none;
}

TEST(Read, EscapesGiveTextInUtf8) {
  EXPECT_EQ(read(R"(name: "a\_b\N\xe9\u00b5")").name, "a\u00A0b\u0085\u00E9\u00B5");
  EXPECT_NE(complaint(R"(goal_um: [0, "\_"])").find("\u00A0"), std::string::npos);
}

TEST(Read, ATabThatIndentsIsNamed) {
  for (const char* text : {"start:\n\tx_um: 1\n", "start:\n  y_um: 1\n  \tx_um: 1\n"}) {
    const std::string said = message_of([&] { read_yaml_text<Scene>(text, "s.yaml"); });
    const int line = std::string_view(text).find("y_um") == std::string_view::npos ? 2 : 3;
    EXPECT_TRUE(said.starts_with("s.yaml:" + std::to_string(line) + ":")) << said;
    EXPECT_NE(said.find("tab"), std::string::npos) << said;
  }
  EXPECT_NE(message_of([&] {
              read_yaml_text<Scene>("# \ta\n\t# b\nstart: [1\n", "s.yaml");
            }).find("YAML: "),
            std::string::npos);
}

TEST(Read, ValuesOutOfRange) {
  const Case cases[] = {
      {"planner:\n  step_um: 0", "s.yaml:2:12: step_um is 0 µm, allowed 1..1e5 µm"},
      {"planner:\n  step_um: 100001", "s.yaml:2:12: step_um is 100001 µm, allowed 1..1e5 µm"},
      {"planner: {max_nodes: 0}", "s.yaml:1:22: max_nodes is 0, allowed 1..1e7"},
      {"goal_um: [1, -2e9]", "s.yaml:1:14: goal_um is -2e9 µm, allowed -1e6..1e6 µm"},
      {"tip: {type: fan, opening_deg: 361}", "s.yaml:1:31: opening_deg is 361°, allowed 0..360°"},
      {"limit_s: -1", "s.yaml:1:10: limit_s is -1 s, allowed at least 0 s"},
      {"times_s: [1, 2e9]", "s.yaml:1:14: times_s is 2e9 s, allowed at most 1e9 s"},
      {"seed: -1", "s.yaml:1:7: seed is -1, allowed at least 0"},
      {"seed: 18446744073709551616",
       "s.yaml:1:7: seed is 18446744073709551616, allowed at most 18446744073709551615"},
      {"count: 2147483648", "s.yaml:1:8: count is 2147483648, allowed at most 2147483647"},
      {"count: -2147483649", "s.yaml:1:8: count is -2147483649, allowed at least -2147483648"},
      {"limit_s: .nan", "s.yaml:1:10: limit_s is .nan, must be finite"},
      {"limit_s: -.inf", "s.yaml:1:10: limit_s is -.inf, must be finite"},
      {"limit_s: Infinity", "s.yaml:1:10: limit_s is Infinity, must be finite"},
      {"limit_s: 1e999", "s.yaml:1:10: limit_s must be a number, not '1e999'"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
  EXPECT_EQ(read("planner: {step_um: 1}").planner.step, 1);
  EXPECT_EQ(read("planner: {step_um: 1e5}").planner.step, 1e5);
  // The double nearest to 0.001 is greater than 0.001.
  EXPECT_EQ(std::get<Disc>(read("tip: {type: disc, radius_um: 0.001}").tip).radius, 0.001);
}

TEST(Read, UnknownWords) {
  const Case cases[] = {
      {"planner: {walls: slid}",
       "s.yaml:1:18: walls is 'slid', did you mean 'slide'? Allowed: slide, stop"},
      {"planner: {walls: [slide]}", "s.yaml:1:18: walls is a list of 1, allowed: slide, stop"},
      {"kinds: [stop, 1]", "s.yaml:1:15: kinds is '1', allowed: slide, stop"},
      {"tip:\n  type: fna",
       "s.yaml:2:9: type of tip is 'fna', did you mean 'fan'? Allowed: disc, fan, nothing"},
      {"tip:\n  type:", "s.yaml:2:3: type of tip is empty, allowed: disc, fan, nothing"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
}

TEST(Read, WhatIsNoYaml) {
  const Case cases[] = {
      {"a: [1, 2", "s.yaml:1:1: YAML: end of sequence flow not found"},
      {"name: a\n seed: 1", "s.yaml:2:6: YAML: illegal map value"},
      {"name: a\nplanner:\n\tstep_um: 3",
       "s.yaml:3:1: a tab indents this line: YAML is indented by blanks only"},
      {"name: 'a", "s.yaml:1:9: YAML: illegal EOF in scalar"},
      {"name: a\nb\x04", "s.yaml:2:2: byte 0x04 is not text in UTF-8"},
      {"name: \xff", "s.yaml:1:7: byte 0xff is not text in UTF-8"},
      {"name: \xc0\xaf", "s.yaml:1:7: byte 0xc0 is not text in UTF-8"},
      {"name: µ\xed\xa0\x80", "s.yaml:1:8: byte 0xed is not text in UTF-8"},
      {"seed: 1\n---\nseed: 2", "s.yaml:2:1: a second document begins, only one is allowed"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
}

TEST(Read, PartsOfYamlWithoutAPlaceHere) {
  const Case cases[] = {
      {"name: &a x", "s.yaml:1:7: anchors (&name) are not supported"},
      {"seed: *a", "s.yaml:1:7: YAML: the referenced anchor is not defined"},
      {"name: !!str 3", "s.yaml:1:7: tags (!name) are not supported"},
      {"[a, b]: 3", "s.yaml:1:1: a key must be a word"},
      {"? {a: b}\n: 3", "s.yaml:1:3: a key must be a word"},
      {"<<: {seed: 3}", "s.yaml:1:1: merge keys (<<) are not supported: write the keys out"},
      {"planner:\n  <<: {step_um: 3}",
       "s.yaml:2:3: merge keys (<<) are not supported: write the keys out"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(complaint(text), message);
}

TEST(Read, DepthAndSizeHaveLimits) {
  const auto nested = [](std::size_t n, std::string_view open) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += open;
    return text;
  };
  for (std::string_view open : {"[", "{a: ", "- ", "? ", "[{a: ", "- ? "})
    for (std::size_t n : {100u, 50'000u})
      EXPECT_TRUE(complaint(nested(n, open)).ends_with(": nested deeper than 64")) << open;
  EXPECT_TRUE(test::is_one_line_naming(complaint(std::string((16 << 20) + 1, '#')), "s.yaml",
                                       {"16777216", "bytes"}));
}

TEST(Read, Files) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("microswarm_read_" + std::to_string(::getpid()) + ".yaml");
  write_file_atomically(path, "planner: {step_um: 33}\n");
  EXPECT_EQ(read_yaml_file<Scene>(path).planner.step, 33);
  write_file_atomically(path, "sede: 3\n");
  EXPECT_EQ(message_of([&] { read_yaml_file<Scene>(path); }),
            path.string() + ":1:1: unknown key 'sede', did you mean 'seed'?");
  std::filesystem::remove(path);
  EXPECT_EQ(message_of([&] { read_yaml_file<Scene>(path); }),
            path.string() + ": cannot read: No such file or directory");
}

}  // namespace
}  // namespace microswarm::sample
