// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/steering_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm {

SteeringCycle::SteeringCycle(const SwarmLimits& swarm, double speed, Vec2 goal,
                             double goal_tolerance, double frame_timeout)
    : swarm_(swarm),
      speed_(std::min(speed, swarm.max_speed)),
      goal_(goal),
      aim_{.position = goal, .tolerance = goal_tolerance},
      goal_tolerance_(goal_tolerance),
      frame_timeout_(frame_timeout),
      compensator_(swarm) {}

void SteeringCycle::prepare(const Snapshot& world, double least, double wanted) {
  aim_ = aim_at(Snapshot(world.shared_map()), goal_, goal_tolerance_, least, wanted);
}

double SteeringCycle::wall_clearance(double wanted, Vec2 p, double reach) const {
  return aim_.wall_clearance(swarm_.radius, wanted, p, reach);
}

bool SteeringCycle::sees_swarm(const Observation& seen) const {
  return seen.swarm && seen.world && is_finite(seen.swarm->pose.position) &&
         std::isfinite(seen.swarm->pose.heading) && std::isfinite(seen.swarm->radius) &&
         seen.age() <= frame_timeout_ && seen.world->map().is_free(seen.swarm->pose.position, 0);
}

bool SteeringCycle::begin(const Observation& seen) {
  view_ = {};
  now_ = seen.now;
  why_hold_ = NavigatorState::blind;
  return sees_swarm(seen);
}

const Pose2& SteeringCycle::compensate(const Observation& seen) {
  delay_ = seen.age() + swarm_.response_lag;
  pose_ = compensator_.at_effect(seen);
  return pose_;
}

const Pose2* SteeringCycle::observe(const Observation& seen) {
  if (!begin(seen)) return nullptr;
  if (!arrives(compensate(seen).position)) return &pose_;
  why_hold_ = NavigatorState::arrived;
  return nullptr;
}

Command SteeringCycle::command(const Command& command, NavigatorState state) {
  view_.state = state;
  last_command_ = now_;
  compensator_.note(now_, command);
  return command;
}

void SteeringCycle::overruled(double now, const Command& command) {
  last_command_ = now;
  compensator_.note(now, command);
}

}  // namespace microswarm
