// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

namespace microswarm::navigation {

/// Complete plan made by one base policy.
struct BasePlan {
  RolloutPlan plan{};
  Aggregation method = Aggregation::heuristic;
};

/// The shorter one of simulated HRA and DCA; nothing if neither gathers the robots within
/// `max_steps`.
std::optional<BasePlan> shortest_base_plan(RolloutSimulator& simulator, const Robots& robots);

/// Plan for robots that deviated: by the rest of their plan or by either policy, whichever is
/// shortest for a few representative robots; simulated with all. Nothing if none gathers them
/// within `max_steps`.
std::optional<RolloutPlan> corrected_plan(RolloutSimulator& simulator, const Robots& robots,
                                          std::span<const Vec2> rest);

}  // namespace microswarm::navigation
