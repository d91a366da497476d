// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_search.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr std::size_t interval = RolloutPlan::checkpoint_interval;

/// The plan's first `step` moves, from the last checkpoint before, with representative robots.
PartialPlan first_steps(const RolloutExecution& plan, std::size_t step,
                        RolloutSimulator& simulator) {
  const RolloutParams& params = simulator.params().rollout;
  const std::size_t mark = step / interval;
  PartialPlan partial{plan.checkpoints()[mark], mark * interval};
  partial.merged.coarsen(static_cast<std::size_t>(params.representatives),
                         params.tuning.finest_cell * simulator.params().step);
  simulator.follow(partial, plan.moves().subspan(partial.from), step);
  return partial;
}

}  // namespace

void RolloutSearch::start(const RolloutParams& params) {
  layers_.reset();
  by_layers_ = params.candidates > 0;
  changes_until_ = spent_;
}

void RolloutSearch::improve(RolloutExecution& plan, RolloutSimulator& simulator, double budget,
                            const Stop& stop) {
  const double begun = simulator.work();
  const double before = spent_;
  const double max_work = simulator.params().rollout.max_work;
  if (max_work > 0) budget = std::min(budget, max_work - spent_);
  const auto may_go_on = [&] {
    spent_ = before + simulator.work() - begun;
    return simulator.work() - begun < budget && !stop();
  };
  constexpr std::size_t min_left = 2;  // the last move has nothing to be shortened
  while (plan.left() >= min_left && may_go_on())
    if (!by_layers_ || spent_ < changes_until_ || !expand(plan, simulator))
      perturb(plan, simulator);
}

// Searches by layers from a little ahead of the robots. When they come there or the share of the
// work is spent, random changes follow. False when there is no place to begin.
bool RolloutSearch::expand(RolloutExecution& plan, RolloutSimulator& simulator) {
  const RolloutTuning& tuning = simulator.params().rollout.tuning;
  if (!layers_) {
    const auto left = static_cast<double>(plan.left());
    const auto head = static_cast<std::size_t>(plan.done() > 0 ? tuning.head_start * left : 0);
    const std::size_t from = (plan.done() + head + interval - 1) / interval;
    if (from >= plan.checkpoints().size()) return false;
    layers_.emplace(plan, from, simulator);
    layers_until_ = spent_ + tuning.layers_work;
    improved_ = improvements_;
  }
  const bool spent = spent_ >= layers_until_ && layers_->passes() >= tuning.min_passes;
  if (layers_->from() < plan.done() || layers_->is_exhausted() || spent) {
    if (improvements_ == improved_ && layers_->from() >= plan.done())
      verify(layers_->from(), layers_->path_so_far().moves, plan, simulator);
    layers_.reset();
    changes_until_ = spent_ + tuning.changes_work;
    return false;
  }
  if (const auto path = layers_->expand(simulator, plan.steps(), rng_)) {
    const std::vector<MergedRobots> checkpoints =
        verify(layers_->from(), path->moves, plan, simulator);
    layers_->correct(*path, checkpoints, simulator);
  }
  return true;
}

// Changes the plan at one point, then continues with the plan or a base policy.
void RolloutSearch::perturb(RolloutExecution& plan, RolloutSimulator& simulator) {
  PartialPlan partial = first_steps(plan, plan.done() + rng_.below(plan.left()), simulator);
  change(partial, plan, simulator);
  if (simulator.finish(
          partial, rng_.below(2) == 0 ? Aggregation::heuristic : Aggregation::divide_and_conquer,
          plan.steps()))
    verify(partial.from, partial.moves, plan, simulator);
}

void RolloutSearch::change(PartialPlan& partial, const RolloutExecution& plan,
                           RolloutSimulator& simulator) {
  const std::size_t at = partial.steps();
  const std::vector<int>& lengths = simulator.params().rollout.tuning.change_lengths;
  assert(!lengths.empty());
  const auto length = static_cast<std::size_t>(lengths[rng_.below(lengths.size())]);
  const std::size_t most = plan.steps();
  std::size_t goes_on_at = at;
  bool goes_on = rng_.below(3) == 0;
  switch (rng_.below(5)) {
    case 0:  // one robot leads to the end
      simulator.lead(partial, rng_.below(partial.merged.places().size()), most, most);
      break;
    case 1:
      simulator.lead(partial, rng_.below(partial.merged.places().size()), length, most);
      break;
    case 2: {  // all in one direction
      const double any = rng_.uniform(0, 2 * pi);
      const double square = pi / 2 * static_cast<double>(rng_.below(4));
      const Vec2 move = simulator.params().step * unit_vector(rng_.below(2) == 0 ? any : square);
      const std::vector<Vec2> moves(length, move);
      simulator.follow(partial, moves, most);
      break;
    }
    case 3:  // some moves are left out
      goes_on = true;
      goes_on_at = std::min(most, at + 1 + rng_.below(length));
      break;
    default:  // another policy from here on
      goes_on = false;
  }
  if (goes_on) simulator.follow(partial, plan.moves().subspan(goes_on_at), most);
}

// Simulates the plan with all robots. Returns its checkpoints from `from` on.
std::vector<MergedRobots> RolloutSearch::verify(std::size_t from, std::span<const Vec2> moves,
                                                RolloutExecution& plan,
                                                RolloutSimulator& simulator) {
  PartialPlan all{plan.checkpoints()[from / interval], from};
  all.keeps_checkpoints = true;
  simulator.follow_until_gathered(all, moves, plan.steps());
  std::vector<MergedRobots> checkpoints = all.checkpoints;
  if (simulator.finish(all, Aggregation::heuristic, plan.steps()))
    improvements_ += plan.shorten(std::move(all));
  return checkpoints;
}

}  // namespace microswarm
