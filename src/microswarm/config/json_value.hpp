// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// Type-erased implementation of `to_json_value<T>`.
nlohmann::json to_json_value(const Type& type, const void* value);

/// JSON object with every field, equal to the parsed text of `to_json_text`. A non-finite number is
/// null.
template <HasFields T>
nlohmann::json to_json_value(const T& value) {
  return to_json_value(type_of<T>(), &value);
}

}  // namespace microswarm
