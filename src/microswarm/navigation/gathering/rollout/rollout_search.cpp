// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_changes.hpp"

namespace microswarm::navigation {
namespace {

constexpr std::size_t interval = RolloutPlan::checkpoint_interval;

/// Number of moves in which the plan and these moves after `from` steps agree, whole intervals.
std::size_t common_moves(const RolloutExecution& plan, std::size_t from,
                         std::span<const Vec2> moves) {
  const auto rest = plan.moves().subspan(from);
  const auto same = std::ranges::mismatch(rest, moves).in1 - rest.begin();
  return static_cast<std::size_t>(same) / interval * interval;
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
    if (!by_layers_ || spent_ < changes_until_ ||
        !expand(plan, simulator, budget - (spent_ - before)))
      perturb(plan, simulator, budget - (spent_ - before));
}

// Begins to search by layers so far ahead that the robots do not come there before a pass is done.
// False if too little work or time is left for a pass even with few positions.
bool RolloutSearch::begin_layers(const RolloutExecution& plan, RolloutSimulator& simulator,
                                 double budget) {
  constexpr double share = 0.9;      // of the work left
  constexpr double farthest = 0.25;  // share of the plan left at which layers may begin
  const RolloutParams& params = simulator.params().rollout;
  const auto left = static_cast<double>(plan.left());
  const double steps = left / interval * mean_trial(params);
  const auto work_at = [&](std::size_t positions) {
    return steps * params.candidates *
           (static_cast<double>(positions) + params.tuning.step_overhead);
  };
  const auto most = static_cast<std::size_t>(params.lookahead_representatives);
  const auto few = std::min(plan.checkpoints()[plan.done() / interval].positions().size(),
                            static_cast<std::size_t>(params.representatives));
  const double work_left = params.max_work > 0 ? params.max_work - spent_ : infinity;
  const double pass =
      std::min({work_at(most), share * work_left, budget + farthest * left * params.budget});
  if (pass < work_at(few)) return false;
  const double head = std::max(plan.done() > 0 ? params.tuning.head_start * left : 0.0,
                               (pass - budget) / std::max(1.0, params.budget));
  const std::size_t from = (plan.done() + static_cast<std::size_t>(head) + interval - 1) / interval;
  if (from >= plan.checkpoints().size()) return false;
  layers_.emplace(plan, from, simulator);
  pass_until_ = spent_ + pass;
  layers_until_ = spent_ + std::min(params.tuning.layers_work, share * work_left);
  improved_ = improvements_;
  return true;
}

// Searches by layers until the robots come there or the share of the work is spent. Random changes
// follow. False when there is no place to begin.
bool RolloutSearch::expand(RolloutExecution& plan, RolloutSimulator& simulator, double budget) {
  const RolloutTuning& tuning = simulator.params().rollout.tuning;
  if (!layers_ && !begin_layers(plan, simulator, budget)) {
    changes_until_ = spent_ + tuning.changes_work;
    return false;
  }
  const bool spent = spent_ >= layers_until_ && layers_->passes() >= tuning.min_passes;
  if (layers_->from() < plan.done() || layers_->is_exhausted() || spent) {
    if (improvements_ == improved_ && layers_->from() >= plan.done())
      take(layers_->path_so_far(), plan, simulator);
    layers_.reset();
    changes_until_ = spent_ + tuning.changes_work;
    return false;
  }
  if (const auto path = layers_->expand(simulator, plan.steps(), pass_until_ - spent_, rng_))
    take(*path, plan, simulator);
  return true;
}

// Shortens the plan by a path through the layers, if that holds for all robots. Only what differs
// from the plan is simulated.
void RolloutSearch::take(const LayerPath& path, RolloutExecution& plan,
                         RolloutSimulator& simulator) {
  const std::size_t common = common_moves(plan, layers_->from(), path.moves);
  VerifiedPlan all =
      verified(layers_->from() + common, std::span(path.moves).subspan(common), plan, simulator);
  layers_->correct(path, common / interval, all.checkpoints, simulator);
  if (all.is_shorter) improvements_ += plan.shorten(std::move(all.plan));
}

// Tries random changes, as many at once as the budget allows.
void RolloutSearch::perturb(RolloutExecution& plan, RolloutSimulator& simulator, double budget) {
  constexpr double max_at_once = 16;
  constexpr double usual_steps = 150;
  const RolloutParams& params = simulator.params().rollout;
  const double work = std::min(usual_steps, 0.5 * static_cast<double>(plan.left())) *
                      (params.representatives + params.tuning.step_overhead);
  const auto count = static_cast<std::size_t>(std::clamp(budget / work, 1.0, max_at_once));
  if (auto shorter = best_change(plan, simulator, count, rng_))
    improvements_ += plan.shorten(*std::move(shorter));
}

}  // namespace microswarm::navigation
