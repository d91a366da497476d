// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout_policy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr std::size_t checkpoint_interval = RolloutPlan::checkpoint_interval;

}  // namespace

RolloutPolicy::RolloutPolicy(const AggregationMap& map, const RobotStepper& stepper,
                             const AggregationParams& params, Rng rng)
    : simulator_(map, stepper, params),
      params_(params.rollout),
      stepper_(&stepper),
      rng_(rng),
      map_(&map),
      base_(map, params),
      expected_(Robots{}) {}

std::optional<Vec2> RolloutPolicy::next(const Robots& robots, const Stop& stop) {
  if (robots.size() == 0) return std::nullopt;
  const double work_before = simulator_.work();
  const bool begins = robots.size() != expected_.size();
  look(robots, begins || done_ == steps());
  if (mean_distance_ < simulator_.params().sigma) return std::nullopt;
  if (begins) {
    start(robots);
  } else if (leads() && (done_ == steps() || !on_plan(robots))) {
    plan_anew(robots);
  }
  if (!leads()) return base_.next(robots);
  improve(params_.budget - (simulator_.work() - work_before), stop);
  ++made_;
  const Vec2 move = plan_.moves[done_++];
  if (done_ % checkpoint_interval == 0) expected_.merge_coincident();
  stepper_->step(expected_.places(), move, ContactRule::stop);
  return move;
}

// Follows the plan unless there is none, or the robots differ so much from the simulation that it
// would take twice as long as the base policy. Then a policy that observes the robots at every step
// is better.
bool RolloutPolicy::leads() const {
  constexpr std::size_t max_bases = 2;
  return steps() > 0 && made_ + steps_left() <= max_bases * base_steps_;
}

// The mean path length decreases by at most one step per move.
void RolloutPolicy::look(const Robots& robots, bool always) {
  if (!always && --unmeasured_ > 0) return;
  const AggregationParams& p = simulator_.params();
  mean_distance_ = simulator_.mean_distance(MergedRobots(robots));
  unmeasured_ = static_cast<int>(std::clamp((mean_distance_ - p.sigma) / p.step, 1.0, 1e6));
}

bool RolloutPolicy::on_plan(const Robots& robots) const {
  double off = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const PointF p = expected_.place_of(i);
    off += distance(Vec2{robots.x[i], robots.y[i]}, Vec2{p.x, p.y});
  }
  return off <=
         params_.max_deviation * simulator_.params().step * static_cast<double>(robots.size());
}

std::optional<PartialPlan> RolloutPolicy::simulated(const Robots& robots, Aggregation method,
                                                    std::size_t most) {
  PartialPlan partial{MergedRobots(robots)};
  partial.keeps_checkpoints = true;
  if (!simulator_.finish(partial, method, most)) return std::nullopt;
  return partial;
}

// Base plan: the shorter one of the two policies.
void RolloutPolicy::start(const Robots& robots) {
  expected_ = MergedRobots(robots);
  done_ = 0;
  plan_ = {};
  const auto longest = static_cast<std::size_t>(params_.max_steps);
  for (const Aggregation method : {Aggregation::divide_and_conquer, Aggregation::heuristic}) {
    const std::size_t most = plan_.moves.empty() ? longest : steps();
    auto partial = simulated(robots, method, most);
    if (!partial) continue;
    plan_.moves = std::move(partial->moves);
    plan_.checkpoints = std::move(partial->checkpoints);
    AggregationParams base = simulator_.params();
    base.method = method;
    base_ = AggregationPolicy(*map_, base);
  }
  made_ = 0;
  base_steps_ = steps();
  extended_.reset();
  head_start_ = 0;
  looks_ahead_ = params_.candidates > 0;
}

void RolloutPolicy::plan_anew(const Robots& robots) {
  ++replans_;
  MergedRobots some(robots);
  some.coarsen(static_cast<std::size_t>(params_.tuning.replan_representatives),
               params_.tuning.finest_cell * simulator_.params().step);
  const std::span<const Vec2> rest = std::span(plan_.moves).subspan(done_);
  auto most = static_cast<std::size_t>(params_.max_steps);
  std::vector<Vec2> best;
  for (const bool goes_on : {true, false}) {
    for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
      PartialPlan partial{some};
      if (goes_on) simulator_.follow(partial, rest, most);
      if (!simulator_.finish(partial, method, most)) continue;
      best = std::move(partial.moves);
      most = best.size();
    }
  }
  expected_ = MergedRobots(robots);
  done_ = 0;
  PartialPlan partial{MergedRobots(robots)};
  partial.keeps_checkpoints = true;
  simulator_.follow(partial, best, best.size());
  plan_ = {};
  if (best.empty() || !simulator_.finish(partial, Aggregation::heuristic,
                                         static_cast<std::size_t>(params_.max_steps))) {
    start(robots);
    return;
  }
  plan_.moves = std::move(partial.moves);
  plan_.checkpoints = std::move(partial.checkpoints);
  extended_.reset();
}

void RolloutPolicy::improve(double budget, const Stop& stop) {
  const double begun = simulator_.work();
  if (params_.max_work > 0) budget = std::min(budget, params_.max_work - thought_);
  const auto may_go_on = [&] { return simulator_.work() - begun < budget && !stop(); };
  constexpr std::size_t min_left = 2;
  while (steps() >= done_ + min_left && may_go_on()) {
    if (looks_ahead_) {
      looks_ahead_ = extend();
    } else {
      perturb();
    }
  }
  thought_ += simulator_.work() - begun;
}

// Extends a plan by repeated lookahead, starting a little ahead of the robots. If they overtake it,
// it starts twice as far ahead. True while it should continue.
bool RolloutPolicy::extend() {
  if (!extended_ || extended_->from < done_) {
    const std::size_t from = (done_ + head_start_ + checkpoint_interval - 1) / checkpoint_interval;
    if (from >= plan_.checkpoints.size()) return false;
    head_start_ = 2 * head_start_ + checkpoint_interval;
    extended_ = PartialPlan{plan_.checkpoints[from], from * checkpoint_interval};
    extended_->keeps_checkpoints = true;
  }
  const std::vector<Vec2> moves = simulator_.look_ahead(extended_->merged, rng_);
  simulator_.follow(*extended_, moves, steps());
  const bool too_long = extended_->steps() >= steps();
  const bool ends = moves.empty() || simulator_.gathered(extended_->merged);
  if (!ends && !too_long) return true;
  if (ends && simulator_.finish(*extended_, Aggregation::heuristic, steps()))
    adopt(std::move(*extended_));
  extended_.reset();
  return false;
}

PartialPlan RolloutPolicy::partial_at(std::size_t step, std::size_t max_places) {
  const std::size_t mark = step / checkpoint_interval;
  PartialPlan partial{plan_.checkpoints[mark], mark * checkpoint_interval};
  partial.merged.coarsen(max_places, params_.tuning.finest_cell * simulator_.params().step);
  simulator_.follow(partial, std::span(plan_.moves).subspan(partial.from), step);
  return partial;
}

// Changes the plan at one point, then continues with the plan or a base policy.
void RolloutPolicy::perturb() {
  PartialPlan partial = partial_at(done_ + rng_.below(steps() - done_),
                                   static_cast<std::size_t>(params_.representatives));
  change(partial);
  if (simulator_.finish(
          partial, rng_.below(2) == 0 ? Aggregation::heuristic : Aggregation::divide_and_conquer,
          steps()))
    verify(partial);
}

void RolloutPolicy::change(PartialPlan& partial) {
  const std::size_t at = partial.steps();
  const std::vector<int>& lengths = params_.tuning.change_lengths;
  assert(!lengths.empty());
  const auto length = static_cast<std::size_t>(lengths[rng_.below(lengths.size())]);
  const std::size_t most = steps();
  std::size_t goes_on_at = at;
  bool goes_on = rng_.below(3) == 0;
  switch (rng_.below(5)) {
    case 0:  // one robot leads to the end
      simulator_.lead(partial, rng_.below(partial.merged.places().size()), most, most);
      break;
    case 1:
      simulator_.lead(partial, rng_.below(partial.merged.places().size()), length, most);
      break;
    case 2: {  // all in one direction
      const double any = rng_.uniform(0, 2 * pi);
      const double square = pi / 2 * static_cast<double>(rng_.below(4));
      const Vec2 move = simulator_.params().step * unit_vector(rng_.below(2) == 0 ? any : square);
      const std::vector<Vec2> moves(length, move);
      simulator_.follow(partial, moves, most);
      break;
    }
    case 3:  // some moves are left out
      goes_on = true;
      goes_on_at = std::min(most, at + 1 + rng_.below(length));
      break;
    default:  // another policy from here on
      goes_on = false;
  }
  if (goes_on) simulator_.follow(partial, std::span(plan_.moves).subspan(goes_on_at), most);
}

// Simulates the plan with all robots.
void RolloutPolicy::verify(const PartialPlan& partial) {
  PartialPlan all{plan_.checkpoints[partial.from / checkpoint_interval], partial.from};
  all.keeps_checkpoints = true;
  simulator_.follow(all, partial.moves, steps());
  if (simulator_.finish(all, Aggregation::heuristic, steps())) adopt(std::move(all));
}

void RolloutPolicy::adopt(PartialPlan&& partial) {
  if (partial.steps() >= steps()) return;
  const auto kept = static_cast<std::ptrdiff_t>(partial.from);
  plan_.moves.erase(plan_.moves.begin() + kept, plan_.moves.end());
  plan_.moves.insert(plan_.moves.end(), partial.moves.begin(), partial.moves.end());
  const auto checkpoints = static_cast<std::ptrdiff_t>(partial.from / checkpoint_interval);
  plan_.checkpoints.erase(plan_.checkpoints.begin() + checkpoints, plan_.checkpoints.end());
  std::move(partial.checkpoints.begin(), partial.checkpoints.end(),
            std::back_inserter(plan_.checkpoints));
  ++improvements_;
}

}  // namespace microswarm
