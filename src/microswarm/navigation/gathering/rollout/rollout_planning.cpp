// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_planning.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace microswarm::navigation {
namespace {

RolloutPlan to_plan(PartialPlan&& partial) {
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

// The policies advance side by side, so that the one that ends first bounds the other.
std::optional<BasePlan> shortest_base_plan(RolloutSimulator& simulator, const Robots& robots) {
  using Pursuit = RolloutSimulator::Pursuit;
  constexpr std::size_t round = 16 * RolloutPlan::checkpoint_interval;
  constexpr std::array methods{Aggregation::divide_and_conquer, Aggregation::heuristic};
  struct Run {
    PartialPlan partial;
    AggregationPolicy policy;
    Pursuit pursuit = Pursuit::paused;
  };
  std::vector<Run> runs;
  runs.reserve(methods.size());
  for (const Aggregation method : methods)
    runs.push_back({with_checkpoints(robots), simulator.policy(method)});
  const auto is_paused = [](const Run& run) { return run.pursuit == Pursuit::paused; };
  auto most = static_cast<std::size_t>(simulator.params().rollout.max_steps);
  for (std::size_t pause = round; std::ranges::any_of(runs, is_paused); pause += round) {
    simulator.try_each(runs.size(), [&](std::size_t i) {
      Run& run = runs[i];
      if (is_paused(run)) run.pursuit = simulator.pursue(run.partial, run.policy, most, pause);
    });
    for (const Run& run : runs)
      if (run.pursuit == Pursuit::gathered) most = std::min(most, run.partial.steps());
  }
  std::optional<BasePlan> best;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].pursuit == Pursuit::gathered && runs[i].partial.steps() <= most && !best)
      best = {to_plan(std::move(runs[i].partial)), methods[i]};
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
  return to_plan(std::move(partial));
}

}  // namespace microswarm::navigation
