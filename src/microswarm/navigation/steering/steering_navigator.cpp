// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/steering_navigator.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {

std::string_view SteeringNavigator::unsupported_reason(const Task& task) {
  if (task.robots) return "a swarm that is one body: it cannot steer robots one by one";
  return task.goal ? "" : "a goal";
}

SteeringNavigator::SteeringNavigator(const Task& task, double speed)
    : swarm_(task.swarm),
      speed_(std::min(speed, task.swarm.max_speed)),
      goal_(*task.goal),
      aim_{.position = goal_, .tolerance = task.goal_tolerance},
      goal_tolerance_(task.goal_tolerance),
      frame_timeout_(task.frame_timeout),
      compensator_(task.swarm) {}

void SteeringNavigator::choose_aim(const Snapshot& world, double least, double wanted) {
  aim_ = aim_at(Snapshot(world.shared_map()), goal_, goal_tolerance_, least, wanted);
}

Command SteeringNavigator::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  update(seen, stop);
  Decision decision = finish(decision_for(seen, stop), seen);
  decision.command = response().command_for(decision.command, speed_);
  view_.state = decision.state;
  record(seen.now, decision.command);
  return decision.command;
}

Decision SteeringNavigator::decision_for(const Observation& seen, const Stop& stop) {
  if (sees_swarm(seen)) {
    if (!estimate_) return decision_at(seen, stop);
    Observation estimated = seen;
    estimated.swarm = estimate_->update(*seen.swarm, seen.seen, compensator_);
    return decision_at(estimated, stop);
  }
  if (!misses_briefly(seen)) return without_swarm();
  Observation bridged = seen;
  bridged.swarm = estimate_->bridge(seen.seen, compensator_);
  return sees_swarm(bridged) ? decision_at(bridged, stop) : without_swarm();
}

Decision SteeringNavigator::decision_at(const Observation& seen, const Stop& stop) {
  delay_ = seen.age() + swarm_.response_lag;
  pose_ = compensator_.at_effect(seen);
  const Vec2 from = seen.swarm->pose.position;
  if (estimate_) pose_.position = response().moved(from, pose_.position - from, delay_);
  const Moment moment{seen, pose_, stop};
  return arrives(pose_.position) ? at_goal(moment) : decide(moment);
}

bool SteeringNavigator::misses_briefly(const Observation& seen) const {
  return estimate_ && estimate_->shown() && !seen.swarm && seen.now >= *estimate_->shown() &&
         seen.now - *estimate_->shown() <= frame_timeout_;
}

bool SteeringNavigator::sees_swarm(const Observation& seen) const {
  return seen.swarm && seen.world && is_finite(seen.swarm->pose.position) &&
         std::isfinite(seen.swarm->pose.heading) && std::isfinite(seen.swarm->radius) &&
         seen.age() <= frame_timeout_ && seen.world->map().is_free(seen.swarm->pose.position, 0);
}

void SteeringNavigator::record(double now, const Command& command) {
  last_command_ = now;
  compensator_.note(now, command);
}

}  // namespace microswarm::navigation
