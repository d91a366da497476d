// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/setting_keys.hpp"

#include <gtest/gtest.h>

#include <set>

#include "microswarm/config/yaml.hpp"
#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

using Words = std::vector<std::string_view>;

TEST(SettingKeys, EachKeyStandsOnceWithItsWords) {
  std::set<std::string> seen;
  for (const SettingKey& key : setting_keys(type_of<Scene>())) {
    EXPECT_TRUE(seen.insert(key.key).second) << key.key;
    EXPECT_FALSE(key.doc.empty()) << key.key;
    if (key.key == "noisy") {
      EXPECT_EQ(key.words, (Words{"true", "false"}));
    }
    if (key.key == "planner.walls") {
      EXPECT_EQ(key.words, (Words{"slide", "stop"}));
    }
    if (key.key == "tip.type") {
      EXPECT_EQ(key.words, (Words{"disc", "fan", "nothing"}));
    }
  }
  for (const char* key : {"name", "start.x_um", "planner.step_um", "tip.type", "tip.radius_um",
                          "tip.opening_deg", "second.max_nodes", "limit_s", "obstacles"})
    EXPECT_TRUE(seen.contains(key)) << key;
  EXPECT_FALSE(seen.contains("planner"));
}

TEST(SettingKeys, WhatIsOfferedIsAccepted) {
  for (const SettingKey& key : setting_keys(type_of<Scene>()))
    for (const std::string_view word : key.words) {
      Scene scene;
      const std::string setting = key.key + "=" + std::string(word);
      if (setting == "tip.type=disc") continue;  // requires a radius
      EXPECT_NO_THROW(set_values(scene, {setting})) << setting;
    }
}

}  // namespace
}  // namespace microswarm::sample
