// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/path_navigator.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm {

PathNavigator::PathNavigator(const PathNavigatorParams& params, const SwarmLimits& swarm, Vec2 goal,
                             double goal_tolerance, double frame_timeout)
    : params_(params),
      helm_(swarm, params.speed, goal, goal_tolerance, frame_timeout),
      follower_(params.follower, swarm),
      path_{goal} {
  path_.insert(path_.begin(), params.path.begin(), params.path.end());
  path_.reserve(2);
}

void PathNavigator::prepare(const Snapshot& world) {
  helm_.prepare(world, helm_.swarm().radius, helm_.swarm().radius + params_.margin);
  path_.back() = helm_.aim();
}

NavigatorView PathNavigator::view() const {
  NavigatorView view = helm_.view();
  view.path = path_;
  view.phased_goal = view.local_target;
  return view;
}

Command PathNavigator::step(const Observation& seen, const Stop&) {
  if (helm_.sees_swarm(seen)) follower_.see(seen, helm_.forecast());
  const Pose2* pose = helm_.begin(seen);
  if (!pose) return helm_.rest();
  if (path_.size() < 2) path_.insert(path_.begin(), seen.swarm->pose.position);
  const auto next = follower_.command(path_, place_, *pose, params_.lookahead, helm_.speed());
  helm_.show_target(point_ahead(path_, place_, params_.lookahead));
  if (!way_is_clear(*seen.world, *pose))
    return helm_.issue({pose->heading, 0}, NavigatorState::hold);
  return helm_.issue(next.command,
                     next.handed_over ? NavigatorState::fallback : NavigatorState::follow);
}

/// The way that the follower will lead in the next `horizon` seconds, or to the goal.
bool PathNavigator::way_is_clear(const Snapshot& world, Pose2 pose) const {
  constexpr double tick = 0.1;  // [s]
  constexpr double rounding = 1e-9;
  const double wanted = helm_.wall_clearance(helm_.swarm().radius + params_.margin, pose.position,
                                             helm_.speed() * params_.horizon);
  const double r = std::min(wanted, (1 - rounding) * world.clearance(pose.position));
  PathPlace place = place_;
  for (double t = 0; t < params_.horizon && !helm_.arrives(pose.position); t += tick) {
    const auto next =
        follower_.command(path_, place, pose, params_.lookahead, helm_.speed()).command;
    const Pose2 moved = unicycle_step(pose, next, helm_.swarm().max_turn_rate, tick);
    if (!world.is_free(Segment{pose.position, moved.position}, r)) return false;
    pose = moved;
  }
  return true;
}

}  // namespace microswarm
