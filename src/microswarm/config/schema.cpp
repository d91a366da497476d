// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/config/write.hpp"

namespace microswarm {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  const bool whole = value == std::floor(value) && std::abs(value) < 0x1p53;
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json number_schema(std::string_view type, const Range& range) {
  Json schema = {{"type", type}};
  if (std::isfinite(range.min)) schema["minimum"] = number(range.min);
  if (std::isfinite(range.max)) schema["maximum"] = number(range.max);
  return schema;
}

/// Default of a field for its schema; null for a group of keys, whose fields have their own.
Json default_json(const Field& field, const void* record) {
  const TypeKind kind = field.type->kind;
  if (field.info.required || kind == TypeKind::record || kind == TypeKind::variant) return nullptr;
  return Json::parse(json_line(*field.type, field.info.unit, field.in(record)));
}

Json to_schema(const Type& type, const FieldInfo& info, const void* defaults);

Json record_schema(const Type& type, const void* defaults, std::string_view type_name = {}) {
  Json properties = Json::object(), required = Json::array();
  if (!type_name.empty()) {
    properties["type"] = {{"const", type_name}};
    required.push_back("type");
  }
  for (const Field& field : type.fields) {
    Json property = to_schema(*field.type, field.info, field.in(defaults));
    std::string doc(field.info.doc);
    if (field.info.unit != Unit::none) doc += fmt::format(" [{}]", unit_symbol(field.info.unit));
    if (!doc.empty()) property["description"] = doc;
    if (Json value = default_json(field, defaults); !value.is_null()) property["default"] = value;
    properties[field.key] = property;
    if (field.info.required) required.push_back(field.key);
  }
  Json schema = {{"type", "object"}, {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

Json to_schema(const Type& type, const FieldInfo& info, const void* defaults) {
  switch (type.kind) {
    case TypeKind::boolean:
      return {{"type", "boolean"}};
    case TypeKind::integer:
      return number_schema("integer", info.range);
    case TypeKind::index:
    case TypeKind::count:
      return number_schema("integer", {std::max(info.range.min, 0.0), info.range.max});
    case TypeKind::number:
      return number_schema("number", info.range);
    case TypeKind::text:
      return {{"type", "string"}};
    case TypeKind::point:
      return {{"type", "array"},
              {"items", number_schema("number", info.range)},
              {"minItems", 2},
              {"maxItems", 2}};
    case TypeKind::choice:
      return {{"enum", type.words}};
    case TypeKind::record:
      return record_schema(type, defaults);
    case TypeKind::optional:
    case TypeKind::list: {
      const Json content = to_schema(*type.parts[0], info, type.parts[0]->defaults);
      if (type.kind == TypeKind::list) return {{"type", "array"}, {"items", content}};
      return {{"anyOf", Json::array({content, {{"type", "null"}}})}};
    }
    case TypeKind::variant: {
      Json alternatives = Json::array();
      for (std::size_t i = 0; i < type.parts.size(); ++i)
        alternatives.push_back(
            record_schema(*type.parts[i], type.parts[i]->defaults, type.words[i]));
      return {{"type", "object"}, {"oneOf", alternatives}};
    }
  }
  return {};
}

}  // namespace

std::string json_schema(const Type& type, std::string_view title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(to_schema(type, {}, type.defaults));
  return schema.dump(2) + "\n";
}

}  // namespace microswarm
