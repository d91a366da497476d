// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/path_navigator.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm {

PathNavigator::PathNavigator(const PathNavigatorParams& params, const SwarmLimits& swarm, Vec2 goal,
                             double goal_tolerance, double frame_timeout)
    : params_(params),
      steering_(swarm, params.speed, goal, goal_tolerance, frame_timeout),
      follower_(params.follower, swarm),
      path_{goal} {
  path_.insert(path_.begin(), params.path.begin(), params.path.end());
  path_.reserve(2);
}

void PathNavigator::prepare(const Snapshot& world, const Stop&) {
  steering_.prepare(world, steering_.swarm().radius, steering_.swarm().radius + params_.gap);
  path_.back() = steering_.aim().position;
}

NavigatorView PathNavigator::view() const {
  NavigatorView view = steering_.view();
  view.path = path_;
  view.phased_goal = view.local_target;
  return view;
}

Command PathNavigator::step(const Observation& seen, const Stop&) {
  if (steering_.sees_swarm(seen)) follower_.update(seen, steering_.compensator());
  const Pose2* pose = steering_.observe(seen);
  if (!pose) return steering_.hold();
  if (path_.size() < 2) path_.insert(path_.begin(), seen.swarm->pose.position);
  const auto next = follower_.command(path_, place_, *pose, params_.lookahead, steering_.speed());
  steering_.view().local_target = point_ahead(path_, place_, params_.lookahead);
  if (!path_is_clear(*seen.world, *pose))
    return steering_.command({pose->heading, 0}, NavigatorState::hold);
  return steering_.command(next.command,
                           next.handed_over ? NavigatorState::fallback : NavigatorState::follow);
}

/// Whether the follower's path over the next `horizon` seconds, or to the goal, is clear.
bool PathNavigator::path_is_clear(const Snapshot& world, Pose2 pose) const {
  constexpr double tick = 0.1;  // [s]
  constexpr double rounding = 1e-9;
  const double wanted = steering_.wall_clearance(
      steering_.swarm().radius + params_.gap, pose.position, steering_.speed() * params_.horizon);
  const double r = std::min(wanted, (1 - rounding) * world.clearance(pose.position));
  PathPlace place = place_;
  for (double t = 0; t < params_.horizon && !steering_.arrives(pose.position); t += tick) {
    const auto next =
        follower_.command(path_, place, pose, params_.lookahead, steering_.speed()).command;
    const Pose2 moved = unicycle_step(pose, next, steering_.swarm().max_turn_rate, tick);
    if (!world.is_free(Segment{pose.position, moved.position}, r)) return false;
    pose = moved;
  }
  return true;
}

}  // namespace microswarm
