// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

namespace microswarm::navigation {

/// A plan with other moves from some step on, simulated with all robots.
struct VerifiedPlan {
  PartialPlan plan;
  /// Robots along the given moves, before HRA took over.
  std::vector<MergedRobots> checkpoints{};
  bool is_shorter = false;
};

/// Simulates the plan with these moves after `from` steps, a multiple of the checkpoint interval,
/// and HRA until all are gathered.
VerifiedPlan verified(std::size_t from, std::span<const Vec2> moves, const RolloutExecution& plan,
                      RolloutSimulator& simulator);

/// The shortest of `count` plans that each have one random change in the moves left; nothing if
/// none is shorter than the plan. Some moves are removed or replaced: by the straight line, by one
/// leading robot, or by one direction; or another policy takes over. All begin at one checkpoint
/// with the same few representative robots. The half with less remaining work after equally many
/// steps continues (sequential halving). Shorter plans are then simulated with all robots.
std::optional<PartialPlan> best_change(const RolloutExecution& plan, RolloutSimulator& simulator,
                                       std::size_t count, Rng& rng);

}  // namespace microswarm::navigation
