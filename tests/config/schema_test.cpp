// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "microswarm/config/write.hpp"
#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

using Json = nlohmann::json;

bool fits(const Json& value, const Json& schema);

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

bool fits_object(const Json& value, const Json& schema) {
  for (const auto& key : schema.value("required", Json::array()))
    if (!value.contains(key)) return false;
  if (!schema.contains("properties")) return true;
  for (const auto& [key, part] : value.items()) {
    if (!schema["properties"].contains(key)) return schema.value("additionalProperties", true);
    if (!fits(part, schema["properties"][key])) return false;
  }
  return true;
}

/// The part of JSON Schema that our schemas use.
bool fits(const Json& value, const Json& schema) {
  if (schema.contains("type") && !has_type(value, schema["type"])) return false;
  if (schema.contains("const") && value != schema["const"]) return false;
  if (schema.contains("enum")) {
    bool known = false;
    for (const auto& word : schema["enum"]) known |= word == value;
    if (!known) return false;
  }
  if (schema.contains("minimum") && value < schema["minimum"]) return false;
  if (schema.contains("maximum") && value > schema["maximum"]) return false;
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", std::size_t{0})) return false;
    if (value.size() > schema.value("maxItems", ~std::size_t{0})) return false;
    for (const auto& item : value)
      if (!fits(item, schema["items"])) return false;
  }
  std::size_t one = 0, any = 0;
  for (const auto& part : schema.value("oneOf", Json::array())) one += fits(value, part);
  for (const auto& part : schema.value("anyOf", Json::array())) any += fits(value, part);
  if (schema.contains("oneOf") && one != 1) return false;
  if (schema.contains("anyOf") && any == 0) return false;
  return !value.is_object() || fits_object(value, schema);
}

const Json& scene_schema() {
  static const Json schema = Json::parse(json_schema<Scene>("scene"));
  return schema;
}

TEST(Schema, SaysWhatItIs) {
  const Json& schema = scene_schema();
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["title"], "scene");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_FALSE(schema.contains("required"));
}

TEST(Schema, CarriesRangesUnitsDocsAndDefaults) {
  const Json& step = scene_schema()["properties"]["planner"]["properties"]["step_um"];
  EXPECT_EQ(step, Json::parse(R"({"type": "number", "minimum": 1, "maximum": 100000, "default": 25,
                                  "description": "Length of one extension. [µm]"})"));
  const Json& goal = scene_schema()["properties"]["goal_um"];
  EXPECT_EQ(goal["minItems"], 2);
  EXPECT_EQ(goal["default"], Json::parse("[100, 0]"));
  const Json& shape =
      scene_schema()["properties"]["obstacles"]["items"]["properties"]["shape"]["oneOf"];
  ASSERT_EQ(shape.size(), 3u);
  EXPECT_EQ(shape[0]["required"], Json::parse(R"(["type", "radius_um"])"));
  EXPECT_EQ(shape[1]["properties"]["type"]["const"], "fan");
  EXPECT_EQ(shape[1]["properties"]["opening_deg"]["default"], 30);
}

TEST(Schema, EveryKeyHasADescription) {
  for (const auto& [key, property] : scene_schema()["properties"].items())
    EXPECT_FALSE(property.value("description", "").empty()) << key;
}

TEST(Schema, FitsWhatIsWritten) {
  Scene scene;
  EXPECT_TRUE(fits(Json::parse(to_json_text(scene)), scene_schema()));
  scene.tip = Fan{};
  scene.second = Planner{};
  scene.limit = 3;
  scene.obstacles = {{Disc{}, {{1, 2}}}, {Nothing{}, {}}};
  const Json good = Json::parse(to_json_text(scene));
  EXPECT_TRUE(fits(good, scene_schema()));
  EXPECT_TRUE(fits(Json::object(), scene_schema()));
}

TEST(Schema, RefusesWhatReadingRefuses) {
  for (const char* text :
       {R"({"sede": 3})", R"({"seed": -1})", R"({"planner": {"step_um": 0}})",
        R"({"planner": {"walls": "slid"}})", R"({"goal_um": [1, 2, 3]})", R"({"noisy": 1})",
        R"({"tip": {"radius_um": 3}})", R"({"tip": {"type": "disc"}})", R"({"count": 1.5})",
        R"({"tip": {"type": "fan", "radius_um": 3}})", R"({"obstacles": [{}]})",
        R"({"limit_s": -1})", R"({"name": null})"})
    EXPECT_FALSE(fits(Json::parse(text), scene_schema())) << text;
}

}  // namespace
}  // namespace microswarm::sample
