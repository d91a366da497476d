// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/straight.hpp"

#include <algorithm>

namespace microswarm {
namespace {

constexpr double lookahead_tick = 0.1;  // of the look ahead [s]
constexpr int most_ticks = 200;

}  // namespace

Command StraightNavigator::step(const Observation& seen, const Stop&) {
  const Pose2* pose = helm_.begin(seen);
  if (!pose) return helm_.rest();
  helm_.show_target(helm_.goal());
  if (!way_is_clear(*seen.world, *pose)) return helm_.issue({pose->heading, 0}, "hold");
  return helm_.issue({heading_of(helm_.goal() - pose->position), helm_.speed()}, "follow");
}

/// The way to the goal as the swarm turns into it, up to the stop distance.
bool StraightNavigator::way_is_clear(const Snapshot& world, Pose2 pose) const {
  constexpr double rounding = 1e-9;
  const double wanted = helm_.swarm().radius + params_.margin;
  const double r = std::min(wanted, (1 - rounding) * world.clearance(pose.position));
  double left = std::min(params_.stop_distance, distance(pose.position, helm_.goal()));
  for (int k = 0; k < most_ticks && left > rounding; ++k) {
    const Command command{heading_of(helm_.goal() - pose.position), helm_.speed()};
    const bool aligned = std::isinf(helm_.swarm().max_turn_rate) ||
                         std::abs(wrap(command.heading - pose.heading)) < rounding;
    const double dt =
        aligned ? left / command.speed : std::min(lookahead_tick, left / command.speed);
    const Pose2 next = unicycle_step(pose, command, helm_.swarm().max_turn_rate, dt);
    if (!world.is_free(Segment{pose.position, next.position}, r)) return false;
    pose = next;
    left -= command.speed * dt;
  }
  return true;
}

}  // namespace microswarm
