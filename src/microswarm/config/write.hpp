// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// Type-erased implementation of `to_yaml<T>` and `to_json_text<T>`.
std::string to_yaml(const Type& type, const void* value);
std::string to_json_text(const Type& type, const void* value);

/// Value on one line in YAML flow style: "[1, 2]", "slide", "1.0e+5", "{x_um: 0, y_um: 1}".
std::string yaml_line(const Type& type, Unit unit, const void* value);
/// The same as JSON; a non-finite number is null.
std::string json_line(const Type& type, Unit unit, const void* value);

/// YAML with every field, which `read_yaml_text` reads back to the same bits.
template <HasFields T>
std::string to_yaml(const T& value) {
  return to_yaml(type_of<T>(), &value);
}

/// JSON object with every field, which `read_yaml_text` also reads. A non-finite number is null.
template <HasFields T>
std::string to_json_text(const T& value) {
  return to_json_text(type_of<T>(), &value);
}

}  // namespace microswarm
