// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// What `to_yaml` and `to_json_text` do, on a described value.
std::string to_yaml(const Type& type, const void* value);
std::string to_json_text(const Type& type, const void* value);

/// A value on one line in YAML's flow style: "[1, 2]", "slide", "1.0e+5", "{x_um: 0, y_um: 1}".
std::string yaml_line(const Type& type, Unit unit, const void* value);
/// The same as JSON; a number that is not finite is null.
std::string json_line(const Type& type, Unit unit, const void* value);

/// Every field with its key, as `read_yaml_text` reads it back to the same bits.
template <HasFields T>
std::string to_yaml(const T& value) {
  return to_yaml(type_of<T>(), &value);
}

/// Every field with its key as a JSON object; `read_yaml_text` reads that too. A number that is not
/// finite is null.
template <HasFields T>
std::string to_json_text(const T& value) {
  return to_json_text(type_of<T>(), &value);
}

}  // namespace microswarm
