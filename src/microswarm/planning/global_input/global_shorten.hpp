// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/stop.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// How a plan's inputs are played, and what it must reach.
struct GlobalPlay {
  double robostep = 5;
  ContactRule contact = ContactRule::slide;
  double separation = 0;
  double goal_tolerance = 20;
};

/// A solved plan with inputs left out as long as all robots still reach their goals: stretches of
/// inputs, long ones first, then as many from one stretch of equal inputs as from another, until
/// neither makes it shorter any more. Each try plays the rest of the plan. Never longer than
/// `plan`, and `plan` itself when it is not solved; deterministic unless `stop` ends it, which
/// gives the shortest so far. Beyond [global].
GlobalPlan shortened(const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
                     const GlobalPlay& play, const Stop& stop = {});

}  // namespace microswarm
