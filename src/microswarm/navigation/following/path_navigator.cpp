// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/path_navigator.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {

PathNavigator::PathNavigator(const PathNavigatorParams& params, const Task& task, Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      follower_(params.follower, task.swarm),
      path_{goal()} {
  path_.insert(path_.begin(), params.path.begin(), params.path.end());
  path_.reserve(2);
}

void PathNavigator::prepare(const Snapshot& world, const Stop&) {
  choose_aim(world, swarm().radius, swarm().radius + params_.gap);
  path_.back() = aim().position;
  step_view().path = path_;
}

void PathNavigator::update(const Observation& seen, const Stop&) {
  if (sees_swarm(seen)) follower_.update(seen, compensator());
}

Decision PathNavigator::decide(const Moment& moment) {
  if (path_.size() < 2) path_.insert(path_.begin(), moment.seen.swarm->pose.position);
  const auto next = follower_.command(path_, position_, moment.pose, params_.lookahead, speed());
  step_view().local_target = point_ahead(path_, position_, params_.lookahead);
  if (!path_is_clear(moment.world(), moment.pose)) return hold();
  return {next.command, next.handed_over ? NavigatorState::fallback : NavigatorState::follow};
}

Decision PathNavigator::finish(const Decision& decision, const Observation&) {
  step_view().path = path_;
  step_view().phased_goal = step_view().local_target;
  return decision;
}

/// Whether the follower's path over the next `horizon` seconds, or to the goal, is clear.
bool PathNavigator::path_is_clear(const Snapshot& world, Pose2 pose) const {
  constexpr double tick = 0.1;  // [s]
  constexpr double rounding = 1e-9;
  const double wanted =
      wall_clearance(swarm().radius + params_.gap, pose.position, speed() * params_.horizon);
  const double r = std::min(wanted, (1 - rounding) * world.clearance(pose.position));
  PathPosition position = position_;
  for (double t = 0; t < params_.horizon && !arrives(pose.position); t += tick) {
    const auto next = follower_.command(path_, position, pose, params_.lookahead, speed()).command;
    const Pose2 moved = predict_unicycle(pose, next, swarm().max_turn_rate, tick);
    if (!world.is_free(Segment{pose.position, moved.position}, r)) return false;
    pose = moved;
  }
  return true;
}

}  // namespace microswarm::navigation
