// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"

#include <algorithm>

#include "microswarm/navigation/gathering/channel_width.hpp"

namespace microswarm {

AggregationNavigator::AggregationNavigator(const AggregationParams& params,
                                           const RobotSwarmParams& robots, Vec2 goal,
                                           double goal_tolerance, double tick, Rng rng,
                                           double frame_timeout)
    : params_(params),
      robots_(robots),
      goal_(goal),
      goal_tolerance_(goal_tolerance),
      tick_(tick),
      frame_timeout_(frame_timeout),
      rng_(rng) {}

void AggregationNavigator::prepare(const Snapshot& world) {
  params_ = fitted(params_, world.map(), rng_);
  params_.sigma = std::min(params_.sigma, 0.5 * goal_tolerance_);
  params_.step = std::min(params_.step, robots_.max_speed * tick_);
  map_.emplace(world.map(), goal_, params_, rng_);
  policy_.emplace(*map_, params_);
  compensator_.emplace(world.map(), robots_.max_speed * tick_, robots_.contact,
                       robots_.response_lag);
  if (params_.method == Aggregation::rollout)
    rollout_.emplace(*map_, compensator_->stepper(), params_, rng_);
}

Command AggregationNavigator::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  if (!sees_robots(seen, frame_timeout_)) return issue(seen.now, {}, NavigatorState::blind);
  const Robots robots = compensator_->at_effect(seen);
  const std::optional<Vec2> move = rollout_ ? rollout_->next(robots, stop) : policy_->next(robots);
  if (!move) return issue(seen.now, {}, NavigatorState::arrived);
  if (!rollout_) view_.local_target = policy_->waypoint();
  return issue(seen.now, command_for(*move, tick_), NavigatorState::gather);
}

Command AggregationNavigator::issue(double now, Command command, NavigatorState state) {
  compensator_->issued(now, command);
  view_.state = state;
  return command;
}

}  // namespace microswarm
