// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

/// Execution of a plan's inputs, and its goals.
struct GlobalPlay {
  double robostep = 5;
  ContactRule contact = ContactRule::slide;
  double separation = 0;
  double goal_tolerance = 20;
};

/// Shortens a solved plan by leaving out inputs while all robots still reach their goals. It
/// removes stretches of inputs, long ones first, then equal numbers of inputs from two runs of
/// equal inputs, until neither helps. Each attempt simulates the rest of the plan. The result is
/// never longer than `plan`, and is `plan` itself if that is not solved. Deterministic unless
/// `stop` ends it; then the shortest plan so far is returned. Beyond [global].
GlobalPlan shortened(const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
                     const GlobalPlay& play, const Stop& stop = {});

}  // namespace microswarm::planning
