// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

std::string key_text(const FieldInfo& info) {
  const std::string_view suffix = unit_suffix(info.unit);
  std::string key(info.name);
  if (!suffix.empty()) key.append("_").append(suffix);
  return key;
}

}  // namespace microswarm
