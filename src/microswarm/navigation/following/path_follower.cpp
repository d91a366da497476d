// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/path_follower.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {

PathFollower::PathFollower(const FollowerParams& params, const SwarmLimits& swarm)
    : loaded_(params.loaded),
      correct_flow_(params.correct_flow),
      max_turn_rate_(swarm.max_turn_rate),
      lag_(swarm.response_lag) {
  assert(params.model.empty() || loaded_);
  if (params.kind == FollowerKind::learned)
    learned_ = loaded_ ? loaded_.get() : &default_follower_model();
}

void PathFollower::update(const Observation& seen, const DelayCompensator& compensator) {
  if (!knows_flow()) return;
  delay_ = seen.age() + lag_;
  flow_.update(seen, compensator);
}

FollowerQuery PathFollower::query(std::span<const Vec2> path, PathPosition& position,
                                  const Pose2& pose, double speed) const {
  // The delay compensator does not include the flow.
  const Pose2 carried{pose.position + delay_ * flow(), pose.heading};
  position = nearest_position(path, carried.position, position);
  return {path, position, carried, speed, flow(), max_turn_rate_};
}

PathFollower::Answer PathFollower::command(std::span<const Vec2> path, PathPosition& position,
                                           const Pose2& pose, double lookahead,
                                           double speed) const {
  if (!knows_flow()) return {pursue(path, position, pose, lookahead, speed)};
  const FollowerQuery asked = query(path, position, pose, speed);
  if (learned_)
    if (const auto command = learned_->command(asked)) return {*command};
  return {pursue_in_flow(path, position, asked.pose, lookahead, speed, asked.flow),
          learned_ != nullptr};
}

Command pursue_in_flow(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
                       double lookahead, double speed, Vec2 flow) {
  Command command = pursue(path, position, pose, lookahead, speed);
  const Vec2 along = unit_vector(command.heading);
  const double across = along.x * flow.y - along.y * flow.x;
  // No heading holds the line if the flow is as fast as the swarm.
  const double crab = -maths::asin(std::clamp(across / speed, -0.9, 0.9));
  command.heading = wrap(command.heading + crab);
  return command;
}

}  // namespace microswarm::navigation
