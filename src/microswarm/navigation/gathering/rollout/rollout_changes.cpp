// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_changes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::navigation {
namespace {

using Pursuit = RolloutSimulator::Pursuit;
constexpr std::size_t spacing = RolloutPlan::checkpoint_interval;

/// A changed plan that is being simulated with representative robots.
struct Trial {
  PartialPlan partial;
  Rng rng;
  std::size_t goes_on_at = 0;  ///< the plan's move that follows; its end: a policy follows
  std::optional<AggregationPolicy> policy{};
  Pursuit pursuit = Pursuit::paused;
  double work_left = infinity;  ///< when it paused
  std::optional<PartialPlan> shorter{};
};

/// Moves on along the straight way of the plan's moves from `begin` to `end`.
void go_straight(PartialPlan& partial, const RolloutExecution& plan, std::size_t begin,
                 std::size_t end, RolloutSimulator& simulator) {
  Vec2 displacement;
  for (const Vec2 move : plan.moves().subspan(begin, end - begin))
    displacement = displacement + move;
  const double count = std::ceil(norm(displacement) / simulator.params().step - 1e-9);
  if (count < 1) return;
  simulator.follow(partial,
                   std::vector<Vec2>(static_cast<std::size_t>(count), (1 / count) * displacement),
                   plan.steps());
}

void go_in_one_direction(PartialPlan& partial, std::size_t steps, std::size_t most,
                         RolloutSimulator& simulator, Rng& rng) {
  const double any = rng.uniform(0, 2 * pi);
  const double square = pi / 2 * static_cast<double>(rng.below(4));
  const Vec2 move = simulator.params().step * unit_vector(rng.below(2) == 0 ? any : square);
  simulator.follow(partial, std::vector<Vec2>(steps, move), most);
}

/// Makes the change at the current step.
void change(Trial& trial, const RolloutExecution& plan, RolloutSimulator& simulator) {
  Rng& rng = trial.rng;
  PartialPlan& partial = trial.partial;
  const std::vector<int>& lengths = simulator.params().rollout.tuning.change_lengths;
  assert(!lengths.empty());
  const std::size_t at = partial.steps();
  const std::size_t most = plan.steps();
  const auto length = static_cast<std::size_t>(lengths[rng.below(lengths.size())]);
  const std::size_t left_out = 1 + rng.below(length);
  const std::size_t made = 1 + rng.below(left_out);
  const std::size_t position = rng.below(partial.merged.positions().size());
  trial.goes_on_at = std::min(most, at + left_out);
  switch (rng.below(10)) {
    case 0:  // another policy from here on
      trial.goes_on_at = most;
      break;
    case 1:  // the same after one robot has led
      trial.goes_on_at = most;
      simulator.lead(partial, position, rng.below(2) == 0 ? most : length, most);
      break;
    case 2:
      simulator.lead(partial, position, made, most);
      break;
    case 3:
      go_in_one_direction(partial, made, most, simulator, rng);
      break;
    case 4:
    case 5:
      go_straight(partial, plan, at, trial.goes_on_at, simulator);
      break;
    default:;  // moves are left out, which is what shortens a plan the most often
  }
}

/// Simulates the trial up to `pause` steps; verifies it when its robots are gathered.
void advance(Trial& trial, const RolloutExecution& plan, RolloutSimulator& simulator,
             std::size_t pause) {
  PartialPlan& partial = trial.partial;
  const std::size_t most = plan.steps();
  if (trial.goes_on_at < most && partial.steps() < pause) {
    const std::size_t count = std::min(pause - partial.steps(), most - trial.goes_on_at);
    simulator.follow(partial, plan.moves().subspan(trial.goes_on_at, count), most);
    trial.goes_on_at += count;
  }
  if (!trial.policy)
    trial.policy = simulator.policy(trial.rng.below(2) == 0 ? Aggregation::heuristic
                                                            : Aggregation::divide_and_conquer);
  trial.pursuit = simulator.pursue(partial, *trial.policy, most, pause);
  if (trial.pursuit != Pursuit::gathered) return;
  VerifiedPlan all = verified(partial.from, partial.moves, plan, simulator);
  if (all.is_shorter) trial.shorter = std::move(all.plan);
}

/// Remaining work at the `k`-th checkpoint.
double work_left(const PartialPlan& partial, std::size_t k, const RolloutSimulator& simulator) {
  return simulator.left_to_do(k < partial.checkpoints.size() ? partial.checkpoints[k]
                                                             : partial.merged);
}

/// The plan's first moves up to the checkpoint, with representative robots.
PartialPlan with_representatives(const RolloutExecution& plan, std::size_t checkpoint,
                                 const RolloutSimulator& simulator) {
  const RolloutParams& params = simulator.params().rollout;
  MergedRobots some = plan.checkpoints()[checkpoint];
  some.coarsen(static_cast<std::size_t>(params.representatives),
               params.tuning.finest_cell * simulator.params().step);
  PartialPlan partial{some.condensed(), checkpoint * spacing};
  partial.keeps_checkpoints = true;
  return partial;
}

}  // namespace

VerifiedPlan verified(std::size_t from, std::span<const Vec2> moves, const RolloutExecution& plan,
                      RolloutSimulator& simulator) {
  VerifiedPlan all{{plan.checkpoints()[from / spacing], from}};
  all.plan.keeps_checkpoints = true;
  simulator.follow_until_gathered(all.plan, moves, plan.steps());
  all.checkpoints = all.plan.checkpoints;
  all.is_shorter = simulator.finish(all.plan, Aggregation::heuristic, plan.steps()) &&
                   all.plan.steps() < plan.steps();
  return all;
}

std::optional<PartialPlan> best_change(const RolloutExecution& plan, RolloutSimulator& simulator,
                                       std::size_t count, Rng& rng) {
  constexpr std::size_t compared_at = 6;  // checkpoints later, when all changes are made
  const std::size_t begin = plan.done() / spacing;
  const std::size_t checkpoint = begin + rng.below((plan.steps() - 1) / spacing - begin + 1);
  const PartialPlan unchanged = with_representatives(plan, checkpoint, simulator);
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < count; ++i)
    trials.push_back({unchanged, Rng(rng.bits(), Purpose::planner)});
  simulator.try_each(count, [&](std::size_t i) {
    Trial& trial = trials[i];
    const std::size_t at = std::clamp<std::size_t>(unchanged.from + trial.rng.below(spacing),
                                                   plan.done(), plan.steps() - 1);
    simulator.follow(trial.partial, plan.moves().subspan(unchanged.from), at);
    change(trial, plan, simulator);
    advance(trial, plan, simulator, unchanged.from + compared_at * spacing);
    if (trial.pursuit == Pursuit::paused)
      trial.work_left = work_left(trial.partial, compared_at, simulator);
  });
  std::ranges::stable_sort(trials, {}, &Trial::work_left);
  const auto paused = static_cast<std::size_t>(std::ranges::count(
      trials, Pursuit::paused, [](const Trial& trial) { return trial.pursuit; }));
  const std::size_t past_the_end = plan.steps() + spacing;
  simulator.try_each(std::min(paused, std::max<std::size_t>(1, count / 2)),
                     [&](std::size_t i) { advance(trials[i], plan, simulator, past_the_end); });
  const auto steps = [&](const Trial& t) { return t.shorter ? t.shorter->steps() : plan.steps(); };
  return std::move(std::ranges::min_element(trials, {}, steps)->shorter);
}

}  // namespace microswarm::navigation
