// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace microswarm {

/// Behaviour of a point robot that meets a wall.
enum class ContactRule {
  slide,   ///< removes the component of the move normal to the wall, wall after wall [global]
  stop,    ///< stays at the wall for the rest of the move [gather]
  reject,  ///< rejects the whole move, as in the program published with [global]
};
constexpr auto enum_names(ContactRule) {
  return std::array<std::pair<ContactRule, std::string_view>, 3>{{{ContactRule::slide, "slide"},
                                                                  {ContactRule::stop, "stop"},
                                                                  {ContactRule::reject, "reject"}}};
}

}  // namespace microswarm
