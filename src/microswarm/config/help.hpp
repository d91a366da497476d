// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// A key of a file, for help and reference.
struct KeyHelp {
  std::string key{};
  std::string_view unit{};                ///< symbol; empty for none
  std::string default_text{};             ///< as in a file, "required" or "none"; of a group empty
  std::string range{};                    ///< "0..1"; empty for any
  std::vector<std::string_view> words{};  ///< allowed values, if they are words
  std::string_view doc{};
  std::vector<KeyHelp> keys{};   ///< of a group
  std::vector<KeyHelp> types{};  ///< alternatives of a variant: `key` is the type's name
};

/// All keys of such a file, in the order of declaration.
std::vector<KeyHelp> key_help(const Type& type);

/// Type-erased implementation of `help_text<T>`.
std::string help_text(const Type& type);

/// Table of all keys of T for a terminal: key, unit, default, allowed values, meaning. Nested keys
/// are indented; each alternative of a variant follows a line `type: NAME`.
template <HasFields T>
std::string help_text() {
  return help_text(type_of<T>());
}

}  // namespace microswarm
