// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// What `help_text` does, for a described type.
std::string help_text(const Type& type);

/// Table of all keys of T for a terminal: key, unit, default, what is allowed, meaning. Keys within
/// a key are indented below it, a variant's alternatives each below a line `type: NAME`.
template <HasFields T>
std::string help_text() {
  return help_text(type_of<T>());
}

}  // namespace microswarm
