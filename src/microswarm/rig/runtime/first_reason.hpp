// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

namespace microswarm::rig {

/// The first of the reasons that is not empty; empty if there is none.
inline std::string first_reason(std::initializer_list<std::string> reasons) {
  for (const std::string& reason : reasons)
    if (!reason.empty()) return reason;
  return {};
}

}  // namespace microswarm::rig
