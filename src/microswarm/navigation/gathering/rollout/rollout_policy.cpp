// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_policy.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/navigation/gathering/rollout/rollout_planning.hpp"

namespace microswarm::navigation {

RolloutPolicy::RolloutPolicy(const AggregationMap& map, const CommonInput& input,
                             const AggregationParams& params, Rng rng)
    : simulator_(map, input, params), input_(input), map_(&map), base_(map, params), search_(rng) {}

std::optional<Vec2> RolloutPolicy::next(const Robots& robots, const Stop& stop) {
  if (robots.size() == 0) return std::nullopt;
  const double work_before = simulator_.work();
  const bool begins = robots.size() != plan_.robot_count();
  measure(robots, begins || plan_.left() == 0);
  if (distance_left_ < simulator_.params().sigma) return std::nullopt;
  if (begins) {
    start(robots);
  } else if (leads() && (plan_.left() == 0 || !on_plan(robots))) {
    plan_anew(robots);
  }
  if (!leads()) return base_.next(robots);
  const RolloutParams& p = simulator_.params().rollout;
  const double all = begins ? p.first_budget : p.budget;
  const double budget = all - (simulator_.work() - work_before);
  search_.improve(plan_, simulator_, budget, stop);
  ++made_;
  return plan_.advance(input_);
}

// Follows the plan unless there is none, or the robots differ so much from the simulation that it
// would take twice as long as the base policy. Then a policy that observes the robots at every step
// is better.
bool RolloutPolicy::leads() const {
  constexpr std::size_t max_bases = 2;
  return plan_.steps() > 0 && made_ + plan_.left() <= max_bases * base_steps_;
}

// The distance left decreases by at most one step per move.
void RolloutPolicy::measure(const Robots& robots, bool always) {
  if (!always && --unmeasured_ > 0) return;
  const AggregationParams& p = simulator_.params();
  const MergedRobots merged(robots);
  mean_distance_ = simulator_.mean_distance(merged);
  distance_left_ = simulator_.distance_left(merged);
  unmeasured_ = static_cast<int>(std::clamp((distance_left_ - p.sigma) / p.step, 1.0, 1e6));
}

bool RolloutPolicy::on_plan(const Robots& robots) const {
  const AggregationParams& p = simulator_.params();
  return plan_.deviation(robots) <=
         p.rollout.max_deviation * p.step * static_cast<double>(robots.size());
}

void RolloutPolicy::start(const Robots& robots) {
  std::optional<BasePlan> best = shortest_base_plan(simulator_, robots);
  if (best) {
    AggregationParams base = simulator_.params();
    base.method = best->method;
    base_ = AggregationPolicy(*map_, base);
  }
  plan_.start(robots, best ? std::move(best->plan) : RolloutPlan{});
  search_.start(simulator_.params().rollout);
  made_ = 0;
  base_steps_ = plan_.steps();
}

void RolloutPolicy::plan_anew(const Robots& robots) {
  ++replans_;
  auto plan = corrected_plan(simulator_, robots, plan_.moves().subspan(plan_.done()));
  if (!plan) return start(robots);
  plan_.start(robots, *std::move(plan));
  search_.forget_layers();
}

}  // namespace microswarm::navigation
