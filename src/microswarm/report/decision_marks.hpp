// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::report {

/// Diagnostics that a record keeps of the decision at a time [s] of one of its frames; at the end
/// those of the last tick. Nothing if it keeps none.
Diagnostics decision_at(const experiment::Record& record, double t);

/// Draws the data behind a command, with the legend: the radar's screened directions and the one
/// it chose, around the swarm's position `at`; predicted outlines, paler with time; of hierarchical
/// D-RRT* the point that targets lead to, unless it is the goal, and where it waits; of an
/// aggregation the team's branch and the leader among the `robots`.
void draw_decision(Picture& picture, const Diagnostics& shown, const experiment::Scenario& scenario,
                   Vec2 at, std::span<const Vec2> robots = {});

}  // namespace microswarm::report
