// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/config/yaml.hpp"
#include "tests/config/message.hpp"
#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

TEST(Set, ReachesEveryField) {
  Scene scene;
  scene.obstacles.resize(2);
  for (std::string_view assignment :
       {"planner.step_um=60", "planner.walls=slide", "name=a: b #c = d", "goal_um=[1, 2]",
        "start.heading_deg=90", "limit_s=3", "second.max_nodes=7", "times_s=[1, 2]", "noisy=true",
        "obstacles.1.shape.radius_um=30", "tip={type: fan, opening_deg: 10}", "note=", "seed=9"})
    set_value(scene, assignment);
  EXPECT_EQ(scene.planner, (Planner{60, 4000, Walls::slide}));
  EXPECT_EQ(scene.name, "a: b #c = d");
  EXPECT_EQ(scene.goal, (Vec2{1, 2}));
  EXPECT_EQ(scene.start.heading, radians(90));
  EXPECT_EQ(scene.limit, 3);
  EXPECT_EQ(scene.second, (Planner{.max_nodes = 7}));
  EXPECT_EQ(scene.times, (std::vector<double>{1, 2}));
  EXPECT_TRUE(scene.noisy);
  EXPECT_EQ(std::get<Disc>(scene.obstacles[1].shape).radius, 30);
  EXPECT_EQ(std::get<Disc>(scene.obstacles[0].shape).radius, 50);
  EXPECT_EQ(std::get<Fan>(scene.tip).opening, radians(10));
  EXPECT_EQ(scene.note, "");
  EXPECT_EQ(scene.seed, 9u);
  set_value(scene, "limit_s=null");
  set_value(scene, "note=null");
  EXPECT_EQ(scene.limit, std::nullopt);
  EXPECT_EQ(scene.note, std::nullopt);
}

TEST(Set, AnotherTypeBeginsTheVariantAfreshTheSameKeepsWhatIsSet) {
  Scene scene;
  set_value(scene, "tip.type=fan");
  EXPECT_EQ(scene.tip, Shape{Fan{}});
  set_value(scene, "tip.opening_deg=10");
  EXPECT_EQ(std::get<Fan>(scene.tip).opening, radians(10));
  set_value(scene, "tip.type=fan");
  EXPECT_EQ(std::get<Fan>(scene.tip).opening, radians(10));
  Scene fresh;
  set_values(fresh, {"tip.type=fan", "tip.opening_deg=10"});
  EXPECT_EQ(fresh.tip, scene.tip);
}

TEST(Set, TheOrderOfKeysDoesNotMatter) {
  Scene expected;
  set_values(expected, {"tip.type=fan", "tip.opening_deg=10", "seed=3"});
  std::vector<std::string> texts{"seed=3", "tip.opening_deg=10", "tip.type=fan"};
  do {
    Scene scene;
    set_values(scene, {texts, ""});
    EXPECT_EQ(scene, expected) << texts[0] << " " << texts[1];
    KeyLocations locations;
    Issues issues;
    EXPECT_EQ(read_yaml_text<Scene>("{}", "s.yaml", {texts, ""}, locations, issues).tip,
              expected.tip);
  } while (std::ranges::next_permutation(texts).found);
  // Of two types the later one counts, whatever stands between them.
  Scene scene;
  set_values(scene, {"tip.type=nothing", "tip.opening_deg=10", "tip.type=fan"});
  EXPECT_EQ(scene.tip, expected.tip);
}

TEST(Set, ATypeComesBeforeThePartsOfItsOwnVariantOnly) {
  const auto order = [](const std::vector<std::string>& texts) {
    const Settings settings(texts, "");
    std::string joined;
    for (const std::size_t i : types_first(settings.list)) joined += settings.list[i].key + " ";
    return joined;
  };
  EXPECT_EQ(order({"b.x=1", "a.x=1", "a.type=t"}), "b.x a.type a.x ");
  EXPECT_EQ(order({"a.b.x=1", "a.x=1", "a.b.type=t", "a.type=t"}), "a.type a.b.type a.b.x a.x ");
  EXPECT_EQ(order({"ab.x=1", "a.type=t"}), "ab.x a.type ");
  // A whole that is set anew begins a new one.
  EXPECT_EQ(order({"a.x=1", "a={}", "a.y=1", "a.type=t"}), "a.x a a.type a.y ");
  EXPECT_EQ(order({"a.b.x=1", "a={}", "a.b.type=t"}), "a.b.x a a.b.type ");
}

TEST(Set, ComplaintsNameTheKeyAndLeaveTheValue) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"planner.stpe_um=3",
       "--set planner.stpe_um: unknown key 'stpe_um', did you mean 'step_um'?"},
      {"planer.step_um=3", "--set planer.step_um: unknown key 'planer', did you mean 'planner'?"},
      {"planner.step_um=0", "--set planner.step_um: step_um is 0 µm, allowed 1..1e5 µm"},
      {"planner.step_um=fast", "--set planner.step_um: step_um must be a number, not 'fast'"},
      {"planner.step_um=", "--set planner.step_um: step_um must be a number, not empty"},
      {"planner.step_um=.nan", "--set planner.step_um: step_um is .nan, must be finite"},
      {"planner.walls=slid",
       "--set planner.walls: walls is 'slid', did you mean 'slide'? Allowed: slide, stop"},
      {"tip.type=fna",
       "--set tip.type: type of tip is 'fna', did you mean 'fan'? Allowed: disc, fan, nothing"},
      {"tip.opening_deg=3",
       "--set tip.opening_deg: unknown key 'opening_deg', allowed: type, radius_um"},
      {"tip=fan", "--set tip: tip must be a mapping with the key 'type', not 'fan'"},
      {"seed.low=3", "--set seed.low: seed has no parts, so no 'low'"},
      {"obstacles.0.shape.radius_um=3",
       "--set obstacles.0.shape.radius_um: obstacles has 0 entries, counted from 0, and none is "
       "'0'"},
      {"kinds.-1=stop", "--set kinds.-1: kinds has 1 entries, counted from 0, and none is '-1'"},
      {"kinds.=stop", "--set kinds.: kinds has 1 entries, counted from 0, and none is ''"},
      {"goal_um=[1, 2", "--set goal_um:1:1: YAML: end of sequence flow not found"},
      {"name=\xff", "--set name:1:1: byte 0xff is not text in UTF-8"},
      {"planner", "--set 'planner': must be KEY=VALUE"},
      {"=3", "--set '=3': must be KEY=VALUE"},
      {"", "--set '': must be KEY=VALUE"}};
  Scene scene;
  for (const auto& [assignment, message] : cases) {
    EXPECT_EQ(message_of([&, text = assignment] { set_value(scene, text, "--set"); }), message);
    EXPECT_EQ(scene, Scene{});
  }
}

}  // namespace
}  // namespace microswarm::sample
