// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Scales the published lengths and speed [gather], for channels of 10 µm, to channels of `width`
/// [µm]. One step per tick; gathered when the mean path length is at most that width, or the one
/// around the goal, `goal_width` [µm], where that is clearly less. The scenario must have robots, a
/// goal and an aggregating navigator.
void fit_gathering(Scenario& scenario, double width, double goal_width, int max_steps);

/// Gives a scenario a swarm that fits channels of `width` [µm], and a navigator with hierarchical
/// D-RRT* whose lengths and speeds suit both.
void fit_swarm(Scenario& scenario, double width);

}  // namespace microswarm::experiment
