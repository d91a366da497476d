// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// Type-erased implementation of `help_text<T>`.
std::string help_text(const Type& type);

/// Table of all keys of T for a terminal: key, unit, default, allowed values, meaning. Nested keys
/// are indented; each alternative of a variant follows a line `type: NAME`.
template <HasFields T>
std::string help_text() {
  return help_text(type_of<T>());
}

}  // namespace microswarm
