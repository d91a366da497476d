// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/swarm/body/ribbon_params.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/body/vortex_params.hpp"

namespace microswarm {

/// Any single-body swarm, selected at run time by its `type`.
using SwarmParams = std::variant<RibbonParams, VortexParams>;

/// Properties of such a swarm that navigators know.
SwarmLimits swarm_limits(const SwarmParams& params);

}  // namespace microswarm
