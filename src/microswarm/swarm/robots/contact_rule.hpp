// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace microswarm {

/// What a point robot does that meets a wall on its move.
enum class ContactRule {
  slide,   ///< the part of the move normal to the wall is removed, wall after wall [global]
  stop,    ///< it stays at the wall for the rest of the move [gather]
  reject,  ///< it does not make the move at all, as in the program published with [global]
};
constexpr auto enum_names(ContactRule) {
  return std::array<std::pair<ContactRule, std::string_view>, 3>{{{ContactRule::slide, "slide"},
                                                                  {ContactRule::stop, "stop"},
                                                                  {ContactRule::reject, "reject"}}};
}

}  // namespace microswarm
