// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// What `json_schema` does, for a described type.
std::string json_schema(const Type& type, std::string_view title);

/// JSON Schema (draft 2020-12) of the files that `read_yaml_file<T>` takes: types, ranges, words,
/// defaults, required keys, and each field's doc with its unit. Editors complete and check scenario
/// files by it.
template <HasFields T>
std::string json_schema(std::string_view title) {
  return json_schema(type_of<T>(), title);
}

}  // namespace microswarm
