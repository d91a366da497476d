// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace microswarm::formats {

/// Position in a JSON document, as a path from the root; each step is a member or an entry. A step
/// refers to its parent, so the path lives on the stack of the functions that descend it.
struct JsonPlace {
  const JsonPlace* parent = nullptr;  ///< null for the document itself
  std::string_view key{};             ///< member of an object; empty for an entry of an array
  std::size_t index = 0;              ///< entry of an array

  JsonPlace member(std::string_view name) const { return {this, name, 0}; }
  JsonPlace entry(std::size_t i) const { return {this, {}, i}; }
  /// "features[3].geometry"; empty for the document itself.
  std::string text() const;
};

/// Line, from 1, on which the value at `place` begins. `json` must be valid JSON. If `place` does
/// not exist, it is the line of its nearest existing ancestor.
int line_number(std::string_view json, const JsonPlace& place);

}  // namespace microswarm::formats
