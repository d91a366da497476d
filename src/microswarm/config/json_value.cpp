// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/json_value.hpp"

#include <cmath>
#include <string>

#include "microswarm/config/number.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Angles in degrees, as they are written.
nlohmann::json json_number(double value, Unit unit) {
  if (!std::isfinite(value)) return nullptr;
  if (unit != Unit::deg && unit != Unit::deg_per_s) return value;
  return parse_number(shown_number(value, unit)).value();
}

nlohmann::json json_value(const Type& type, Unit unit, const void* value) {
  using Json = nlohmann::json;
  switch (type.kind) {
    case TypeKind::boolean:
      return *static_cast<const bool*>(value);
    case TypeKind::integer:
      return *static_cast<const int*>(value);
    case TypeKind::count:
      return *static_cast<const std::uint64_t*>(value);
    case TypeKind::index:
      return *static_cast<const std::uint32_t*>(value);
    case TypeKind::number:
      return json_number(*static_cast<const double*>(value), unit);
    case TypeKind::text:
      return *static_cast<const std::string*>(value);
    case TypeKind::point: {
      const Vec2& p = *static_cast<const Vec2*>(value);
      return Json::array({json_number(p.x, unit), json_number(p.y, unit)});
    }
    case TypeKind::choice:
      return type.words[type.count(value)];
    case TypeKind::optional:
      return type.count(value) ? json_value(*type.parts[0], unit, type.find_part(value)) : Json();
    case TypeKind::list: {
      Json list = Json::array();
      for (std::size_t i = 0; i < type.count(value); ++i)
        list.push_back(json_value(*type.parts[0], unit, type.find_part(value, i)));
      return list;
    }
    case TypeKind::record: {
      Json object = Json::object();
      for (const Field& field : type.fields)
        object[field.key] = json_value(*field.type, field.info.unit, field.in(value));
      return object;
    }
    case TypeKind::variant: {
      const std::size_t held = type.count(value);
      Json object = json_value(*type.parts[held], unit, type.find_part(value));
      object["type"] = type.words[held];
      return object;
    }
  }
  return nullptr;
}

}  // namespace

nlohmann::json to_json_value(const Type& type, const void* value) {
  return json_value(type, Unit::none, value);
}

}  // namespace microswarm
