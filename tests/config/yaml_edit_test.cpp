// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml_edit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

std::string edited(const std::string& text, const std::vector<Setting>& settings) {
  return edit_yaml(text, "rig.yaml", settings);
}

TEST(YamlEdit, ReplacesAValueAndNothingElse) {
  EXPECT_EQ(edited("# a rig\nname: µ  # speed: 1\nfield: {kind: rolling, speed: 5}  # 5\n",
                   {{"field.speed", "6.25"}}),
            "# a rig\nname: µ  # speed: 1\nfield: {kind: rolling, speed: 6.25}  # 5\n");
  EXPECT_EQ(
      edited("field:\n  # usual\n  speed:   5   # µm/s\n  kind: rolling\n", {{"field.speed", "7"}}),
      "field:\n  # usual\n  speed:   7   # µm/s\n  kind: rolling\n");
}

TEST(YamlEdit, AddsWhatIsMissing) {
  EXPECT_EQ(edited("field: {kind: rolling,\n        text: '}'}  # 5\n", {{"field.speed", "6"}}),
            "field: {kind: rolling,\n        text: '}', speed: 6}  # 5\n");
  EXPECT_EQ(edited("field: {}\nname: a", {{"field.speed", "6"}, {"delay_s", "0.1"}}),
            "field: {speed: 6}\nname: a\ndelay_s: 0.1\n");
  EXPECT_EQ(edited("field:\n  kind: rolling\n\nname: a\n", {{"field.speed", "6"}}),
            "field:\n  kind: rolling\n  speed: 6\n\nname: a\n");
  EXPECT_EQ(edited("name: a\n", {{"field.speed", "6"}}), "name: a\nfield: {speed: 6}\n");
  EXPECT_EQ(edited("name: a\nlist: [1,\n  2]\n", {{"delay_s", "6"}}),
            "name: a\nlist: [1,\n  2]\ndelay_s: 6\n");
}

TEST(YamlEdit, RefusesWhatItCannotDoForCertain) {
  for (const char* text :
       {"field: 5\n", "field: {speed: \"5\"}\n", "field: {speed: [5]}\n", "", "[1, 2]\n",
        "text: >\n  speed\n  is 5\n", "field:\n  text: |\n    of the field\nname: a\n"}) {
    try {
      ADD_FAILURE() << edited(text, {{"field.speed", "6"}});
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("field.speed: 6"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace microswarm
