// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/write.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "microswarm/config/json_value.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

double any_finite(Rng& rng) {
  for (int i = 0; i < 100; ++i)
    if (const double v = std::bit_cast<double>(rng.bits()); std::abs(v) < 1e300) return v;
  return 0;
}

std::string any_text(Rng& rng) {
  constexpr std::string_view pieces[] = {
      "a", "Z",    " ", "\n", "\t", "\"", "\\",  "'",  ":", "#", "µ", "\x01", "-", "0", "{",
      "]", "null", "%", "&",  "*",  "no", "1e5", "\r", "~", "?", "!", "\x7f", "€", ",", "|"};
  std::string text;
  for (std::uint64_t n = rng.below(8); n > 0; --n) text += pieces[rng.below(std::size(pieces))];
  return text;
}

Shape any_shape(Rng& rng) {
  switch (rng.below(3)) {
    case 0:
      return Disc{rng.uniform(1e-3, 1e6)};
    case 1:
      return Fan{rng.uniform(0, 2 * pi * 0.999), any_finite(rng)};
    default:
      return Nothing{};
  }
}

std::vector<Vec2> any_way(Rng& rng, std::uint64_t most) {
  std::vector<Vec2> way(rng.below(most));
  for (Vec2& p : way) p = {rng.uniform(-1e6, 1e6), std::round(rng.uniform(-10, 10))};
  return way;
}

Scene any_scene(Rng& rng) {
  Scene s;
  s.name = any_text(rng);
  s.seed = rng.bits();
  s.noisy = rng.below(2);
  s.start = {{any_finite(rng), any_finite(rng)}, any_finite(rng)};
  s.goal = {rng.uniform(-1e6, 1e6), -0.0};
  s.planner = {rng.uniform(1, 1e5), static_cast<int>(1 + rng.below(1000)), Walls::slide};
  s.tip = any_shape(rng);
  if (rng.below(2)) s.limit = rng.uniform();
  if (rng.below(2)) s.second = Planner{.walls = Walls::slide};
  if (rng.below(2)) s.note = any_text(rng);
  s.times.resize(rng.below(30));
  for (double& t : s.times) t = -std::abs(any_finite(rng));
  for (std::uint64_t n = rng.below(3); n > 0; --n) s.rings.push_back(any_way(rng, 9));
  for (std::uint64_t n = rng.below(4); n > 0; --n)
    s.obstacles.push_back({any_shape(rng), any_way(rng, 6)});
  if (rng.below(2)) s.kinds = {Walls::stop, Walls::slide};
  s.count = static_cast<int>(rng.bits());
  return s;
}

TEST(Write, YamlIsPlainToRead) {
  Scene scene;
  scene.goal = {1e5, 2.5};
  scene.tip = Fan{};
  scene.times = {0, 1e-9, 1e20};
  scene.obstacles = {{Disc{}, {{1, 2}, {3, 4}}}, {Nothing{}, {}}};
  EXPECT_EQ(to_yaml(scene), R"(name: untitled
seed: 1
noisy: false
start:
  x_um: 0
  y_um: 0
  heading_deg: 0
goal_um: [100000, 2.5]
planner:
  step_um: 25
  max_nodes: 4000
  walls: stop
tip:
  type: fan
  opening_deg: 30
  turning_deg_per_s: 0
limit_s: null
second: null
note: "none yet"
times_s: [0, 1.0e-9, 1.0e+20]
rings_um: []
obstacles:
  - shape:
      type: disc
      radius_um: 50
    way_um: [[1, 2], [3, 4]]
  - shape:
      type: nothing
    way_um: []
kinds: [slide]
count: 0
)");
}

TEST(Write, JsonIsPlainToRead) {
  EXPECT_EQ(to_json_text(Obstacle{Disc{}, {{1e5, 2e-9}}}), R"({
  "shape": {
    "type": "disc",
    "radius_um": 50
  },
  "way_um": [[100000, 2e-9]]
}
)");
  EXPECT_EQ(to_json_text(Nothing{}), "{}\n");
  EXPECT_EQ(to_yaml(Nothing{}), "{}\n");
}

TEST(Write, ALongListTakesALineAnEntry) {
  Obstacle obstacle{Disc{}, std::vector<Vec2>(20, {1, 2})};
  EXPECT_NE(to_yaml(obstacle).find("way_um:\n  - [1, 2]\n  - [1, 2]\n"), std::string::npos);
  EXPECT_EQ(read_yaml_text<Obstacle>(to_yaml(obstacle), "o.yaml"), obstacle);
}

TEST(Write, ReadsBackToTheSameBits) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = any_scene(rng);
    const std::string yaml = to_yaml(scene), json = to_json_text(scene);
    ASSERT_EQ(read_yaml_text<Scene>(yaml, "written.yaml"), scene) << yaml;
    ASSERT_EQ(read_yaml_text<Scene>(json, "written.json"), scene) << json;
    ASSERT_EQ(to_yaml(read_yaml_text<Scene>(yaml, "written.yaml")), yaml);
  }
}

TEST(Write, EveryAngleCanBeSpelled) {
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 5000; ++i) {
    const Fan fan{1, i % 2 ? rng.uniform(-pi, pi) : any_finite(rng)};
    ASSERT_EQ(read_yaml_text<Fan>(to_yaml(fan), "fan.yaml").turning, fan.turning) << to_yaml(fan);
  }
}

TEST(Write, AnAngleGivenInDegreesIsWrittenAsItWasGiven) {
  for (int tenths = -3600; tenths <= 3600; tenths += 3) {
    const std::string text =
        std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10));
    const Fan fan = read_yaml_text<Fan>("turning_deg_per_s: " + text, "fan.yaml");
    const std::string written = to_yaml(fan);
    EXPECT_LE(written.substr(written.rfind(' ') + 1).size(), 1 + text.size()) << written;
  }
}

TEST(Write, JsonIsJson) {
  Rng rng(3, Purpose::test);
  for (int i = 0; i < 100; ++i) {
    const Scene scene = any_scene(rng);
    const auto json = nlohmann::json::parse(to_json_text(scene));
    EXPECT_EQ(json["name"], scene.name);
    EXPECT_EQ(json["seed"], scene.seed);
    EXPECT_EQ(json["planner"]["step_um"], scene.planner.step);
    EXPECT_EQ(json["obstacles"].size(), scene.obstacles.size());
    EXPECT_EQ(json["limit_s"].is_null(), !scene.limit);
    EXPECT_EQ(to_json_value(scene), json);
  }
  Fan fan;
  fan.turning = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(nlohmann::json::parse(to_json_text(fan))["turning_deg_per_s"].is_null());
  EXPECT_TRUE(to_json_value(fan)["turning_deg_per_s"].is_null());
  EXPECT_EQ(to_json_value(Nothing{}), nlohmann::json::object());
  EXPECT_NE(to_yaml(fan).find("turning_deg_per_s: .inf\n"), std::string::npos);
}

}  // namespace
}  // namespace microswarm::sample
