// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace microswarm {

/// A place in a JSON document, as the way there from the root: each step is a member or an entry.
/// A step refers to the one before it, so a way lives on the stack of those who walk it.
struct JsonPlace {
  const JsonPlace* parent = nullptr;  ///< none for the document itself
  std::string_view key{};             ///< member of an object; empty for an entry of an array
  std::size_t index = 0;              ///< entry of an array

  JsonPlace member(std::string_view name) const { return {this, name, 0}; }
  JsonPlace entry(std::size_t i) const { return {this, {}, i}; }
  /// "features[3].geometry", empty for the document itself.
  std::string text() const;
};

/// The line, from 1, on which the value at `place` begins. `json` must be valid JSON; when the
/// place is not in it, the line of the nearest value on the way.
int line_of(std::string_view json, const JsonPlace& place);

}  // namespace microswarm
