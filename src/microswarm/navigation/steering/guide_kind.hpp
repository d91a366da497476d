// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace microswarm::navigation {

/// Which way the goal is taken to lie.
enum class Guide {
  straight,  ///< the straight direction, as Eq 4e [drrt] has it
  route,     ///< along the free space of the static map
};
constexpr auto enum_names(Guide) {
  return std::array<std::pair<Guide, std::string_view>, 2>{
      {{Guide::straight, "straight"}, {Guide::route, "route"}}};
}

}  // namespace microswarm::navigation
