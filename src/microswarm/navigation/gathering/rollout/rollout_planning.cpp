// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_planning.hpp"

#include <utility>

namespace microswarm {
namespace {

RolloutPlan plan_of(PartialPlan&& partial) {
  return {std::move(partial.moves), std::move(partial.checkpoints)};
}

PartialPlan with_checkpoints(const Robots& robots) {
  PartialPlan partial{MergedRobots(robots)};
  partial.keeps_checkpoints = true;
  return partial;
}

/// Moves of the shortest plan for representative robots; empty if there is none.
std::vector<Vec2> shortest_moves(RolloutSimulator& simulator, const Robots& robots,
                                 std::span<const Vec2> rest) {
  const RolloutParams& params = simulator.params().rollout;
  MergedRobots some(robots);
  some.coarsen(static_cast<std::size_t>(params.tuning.replan_representatives),
               params.tuning.finest_cell * simulator.params().step);
  auto most = static_cast<std::size_t>(params.max_steps);
  std::vector<Vec2> best;
  for (const bool goes_on : {true, false}) {
    for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
      PartialPlan partial{some};
      if (goes_on) simulator.follow(partial, rest, most);
      if (!simulator.finish(partial, method, most)) continue;
      best = std::move(partial.moves);
      most = best.size();
    }
  }
  return best;
}

}  // namespace

std::optional<BasePlan> shortest_base_plan(RolloutSimulator& simulator, const Robots& robots) {
  auto most = static_cast<std::size_t>(simulator.params().rollout.max_steps);
  std::optional<BasePlan> best;
  for (const Aggregation method : {Aggregation::divide_and_conquer, Aggregation::heuristic}) {
    PartialPlan partial = with_checkpoints(robots);
    if (!simulator.finish(partial, method, most)) continue;
    most = partial.steps();
    best = {plan_of(std::move(partial)), method};
  }
  return best;
}

std::optional<RolloutPlan> corrected_plan(RolloutSimulator& simulator, const Robots& robots,
                                          std::span<const Vec2> rest) {
  const std::vector<Vec2> best = shortest_moves(simulator, robots, rest);
  if (best.empty()) return std::nullopt;
  PartialPlan partial = with_checkpoints(robots);
  simulator.follow(partial, best, best.size());
  const auto most = static_cast<std::size_t>(simulator.params().rollout.max_steps);
  if (!simulator.finish(partial, Aggregation::heuristic, most)) return std::nullopt;
  return plan_of(std::move(partial));
}

}  // namespace microswarm
