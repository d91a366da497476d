// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/json.hpp"

#include <gtest/gtest.h>

#include "microswarm/config/write.hpp"
#include "tests/config/sample.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm {
namespace {

using sample::Scene;

const std::string none = "nothing was thrown";

/// All mistakes in one text.
std::string mistakes(std::string_view text, const JsonLimits& limits = {}) {
  Scene scene;
  Issues issues;
  return test::error_of([&] {
    read_json(scene, text, "message", issues, limits);
    if (!issues.empty()) throw InputError(issues);
  });
}

TEST(Json, WhatIsWrittenIsReadBack) {
  Scene scene{.name = "a \"b\" \\ é 𝄞", .seed = 18446744073709551615u, .noisy = true};
  scene.goal = {-3.25, 1e-7};
  scene.tip = sample::Nothing{};
  scene.limit = 0.1;
  scene.note.reset();
  scene.times = {0, 1.5};
  scene.rings = {{{0, 0}, {1, 0}, {0, 1}}, {}};
  scene.obstacles = {{sample::Disc{20}, {{1, 2}}}};
  Scene read;
  Issues issues;
  read_json(read, to_json_text(scene), "scene", issues);
  EXPECT_TRUE(issues.empty());
  EXPECT_EQ(read, scene);
}

TEST(Json, ATextNeedsItsQuotesAndANumberHasNone) {
  EXPECT_EQ(mistakes(R"({"name": 3})"), "message: name must be a text, not '3'");
  EXPECT_EQ(mistakes(R"({"name": true})"), "message: name must be a text, not 'true'");
  EXPECT_EQ(mistakes(R"({"count": "3"})"),
            "message: count must be a whole number, not the text '3'");
  EXPECT_EQ(mistakes(R"({"count": 1.5})"), "message: count must be a whole number, not '1.5'");
  EXPECT_EQ(mistakes(R"({"noisy": 1})"), "message: noisy must be true or false, not '1'");
  EXPECT_EQ(mistakes(R"({"name": "3", "count": 3, "noisy": true, "note": null})"), none);
}

TEST(Json, EveryMistakeIsNamedWithItsKey) {
  const std::string found = mistakes(R"({"sed": 1, "goal_um": [1], "planner": {"step_um": 0}})");
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 2) << found;
  for (const char* part : {"'seed'", "goal_um", "step_um"})
    EXPECT_NE(found.find(part), std::string::npos) << found;
}

TEST(Json, OtherTextsAreRefusedInOneLine) {
  for (const char* text :
       {"", "{", "nothing", "[]", "3", "null", "{\"seed\":1} x", "\xff\xfe", "{\"name\":\"\xff\"}",
        "{\"count\":NaN}", "{\"limit_s\":1e999}", "{count: 1}", "{\"count\":01}", "{\"count\":1,}",
        "{\"count\":1,\"count\":2}", "{\"planner\":{\"step_um\":1,\"step_um\":2}}", "// a\n{}"})
    EXPECT_TRUE(test::is_one_line_naming(mistakes(text), "message", {})) << text;
}

TEST(Json, SizeAndDepthAreLimited) {
  EXPECT_EQ(mistakes("{}", {.bytes = 2}), none);
  EXPECT_EQ(mistakes("{} ", {.bytes = 2}), "message: 3 bytes, at most 2 are allowed");
  EXPECT_EQ(mistakes(R"({"times_s": [1]})", {.depth = 2}), none);
  EXPECT_EQ(mistakes(R"({"times_s": [[1]]})", {.depth = 2}), "message: nested deeper than 2");
  EXPECT_EQ(mistakes(std::string(200'000, '[')), "message: nested deeper than 64");
}

}  // namespace
}  // namespace microswarm
