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
  extended_.reset();
  head_start_ = 0;
  looks_ahead_ = params.candidates > 0;
}

void RolloutSearch::improve(RolloutExecution& plan, RolloutSimulator& simulator, double budget,
                            const Stop& stop) {
  const double begun = simulator.work();
  const double max_work = simulator.params().rollout.max_work;
  if (max_work > 0) budget = std::min(budget, max_work - spent_);
  const auto may_go_on = [&] { return simulator.work() - begun < budget && !stop(); };
  constexpr std::size_t min_left = 2;  // the last move has nothing to be shortened
  while (plan.left() >= min_left && may_go_on()) {
    if (looks_ahead_) {
      looks_ahead_ = extend(plan, simulator);
    } else {
      perturb(plan, simulator);
    }
  }
  spent_ += simulator.work() - begun;
}

// Extends a plan by repeated lookahead, starting a little ahead of the robots. If they overtake it,
// it starts twice as far ahead. True while it should continue.
bool RolloutSearch::extend(RolloutExecution& plan, RolloutSimulator& simulator) {
  if (!extended_ || extended_->from < plan.done()) {
    const std::size_t from = (plan.done() + head_start_ + interval - 1) / interval;
    if (from >= plan.checkpoints().size()) return false;
    head_start_ = 2 * head_start_ + interval;
    extended_ = PartialPlan{plan.checkpoints()[from], from * interval};
    extended_->keeps_checkpoints = true;
  }
  const std::vector<Vec2> moves = simulator.look_ahead(extended_->merged, rng_);
  simulator.follow(*extended_, moves, plan.steps());
  const bool too_long = extended_->steps() >= plan.steps();
  const bool ends = moves.empty() || simulator.gathered(extended_->merged);
  if (!ends && !too_long) return true;
  if (ends && simulator.finish(*extended_, Aggregation::heuristic, plan.steps()))
    improvements_ += plan.shorten(std::move(*extended_));
  extended_.reset();
  return false;
}

// Changes the plan at one point, then continues with the plan or a base policy.
void RolloutSearch::perturb(RolloutExecution& plan, RolloutSimulator& simulator) {
  PartialPlan partial = first_steps(plan, plan.done() + rng_.below(plan.left()), simulator);
  change(partial, plan, simulator);
  if (simulator.finish(
          partial, rng_.below(2) == 0 ? Aggregation::heuristic : Aggregation::divide_and_conquer,
          plan.steps()))
    verify(partial, plan, simulator);
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

// Simulates the plan with all robots.
void RolloutSearch::verify(const PartialPlan& partial, RolloutExecution& plan,
                           RolloutSimulator& simulator) {
  PartialPlan all{plan.checkpoints()[partial.from / interval], partial.from};
  all.keeps_checkpoints = true;
  simulator.follow(all, partial.moves, plan.steps());
  if (simulator.finish(all, Aggregation::heuristic, plan.steps()))
    improvements_ += plan.shorten(std::move(all));
}

}  // namespace microswarm
