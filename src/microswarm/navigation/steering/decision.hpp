// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/navigator_state.hpp"

namespace microswarm::navigation {

/// Decision of a navigator in a step.
struct Decision {
  Command command{};
  NavigatorState state = NavigatorState::hold;
};

}  // namespace microswarm::navigation
