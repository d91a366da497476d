// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"

#include <algorithm>

#include "microswarm/navigation/gathering/policies/published_scale.hpp"

namespace microswarm {

Issues validate(const AggregationParams& params) {
  Issues issues;
  if (params.rollout.tuning.change_lengths.empty())
    issues.add("rollout.tuning.change_lengths",
               "rollout.tuning.change_lengths is empty, must have a value");
  return issues;
}

AggregationNavigator::AggregationNavigator(const AggregationParams& params,
                                           const RobotSwarmParams& robots, Vec2 goal,
                                           double goal_tolerance, double tick, Rng rng,
                                           double frame_timeout)
    : params_(params),
      goal_(goal),
      goal_tolerance_(goal_tolerance),
      rng_(rng),
      steering_(robots, tick, frame_timeout) {}

void AggregationNavigator::prepare(const Snapshot& world, const Stop& stop) {
  params_ = fitted(params_, world.map(), rng_);
  params_.sigma = std::min(params_.sigma, 0.5 * goal_tolerance_);
  params_.step = std::min(params_.step, steering_.max_move());
  map_.emplace(world.map(), goal_, params_, rng_, MoveRule::any_direction, stop);
  if (map_->was_stopped) {
    map_.reset();
    return;
  }
  policy_.emplace(*map_, params_);
  steering_.prepare(world);
  if (params_.method == Aggregation::rollout)
    rollout_.emplace(*map_, steering_.stepper(), params_, rng_);
}

Command AggregationNavigator::step(const Observation& seen, const Stop& stop) {
  const std::optional<Robots> robots = steering_.observe(seen);
  if (!robots) return steering_.hold();
  const std::optional<Vec2> move =
      rollout_ ? rollout_->next(*robots, stop) : policy_->next(*robots);
  if (!move) return steering_.hold(NavigatorState::arrived);
  if (!rollout_) steering_.view().local_target = policy_->waypoint();
  return steering_.move(*move, NavigatorState::gather);
}

}  // namespace microswarm
