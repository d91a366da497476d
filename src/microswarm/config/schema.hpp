// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// Type-erased implementation of `json_schema<T>`.
std::string json_schema(const Type& type, std::string_view title);

/// JSON Schema (draft 2020-12) of the files that `read_yaml_file<T>` accepts: types, ranges, words,
/// defaults, required keys, and each field's documentation with its unit. Editors use it to
/// complete and check scenario files.
template <HasFields T>
std::string json_schema(std::string_view title) {
  return json_schema(type_of<T>(), title);
}

}  // namespace microswarm
