// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/config/former_keys.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Lowers the clearance of D-RRT* if it is not given and no path from start to goal has it, to the
/// largest one with a path, up to 2 %, and says so in a note. As published it stays as it is.
Notes fit_clearance(Scenario& scenario, const World& world, const IsGiven& is_given);

}  // namespace microswarm::experiment
