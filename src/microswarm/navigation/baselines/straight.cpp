// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/baselines/straight.hpp"

#include <algorithm>

namespace microswarm::navigation {
namespace {

constexpr double lookahead_tick = 0.1;  // time step of the look-ahead [s]
constexpr int max_ticks = 200;

}  // namespace

void StraightNavigator::prepare(const Snapshot& world, const Stop&) {
  choose_aim(world, swarm().radius, swarm().radius + params_.gap);
}

Decision StraightNavigator::decide(const Moment& moment) {
  step_view().local_target = aim().position;
  if (!path_is_clear(moment.world(), moment.pose)) return hold();
  return {{heading_along(aim().position - moment.pose.position), speed()}, NavigatorState::follow};
}

/// Whether the path to the goal, including the turn into it, is clear up to the stop distance.
bool StraightNavigator::path_is_clear(const Snapshot& world, Pose2 pose) const {
  constexpr double rounding = 1e-9;
  const double wanted = swarm().radius + params_.gap;
  const double here = (1 - rounding) * world.clearance(pose.position);
  const double from_bodies = std::min(wanted, here);
  const double from_walls =
      std::min(wall_clearance(wanted, pose.position, params_.stop_distance), here);
  double left = std::min(params_.stop_distance, distance(pose.position, aim().position));
  for (int k = 0; k < max_ticks && left > rounding; ++k) {
    const Command command{heading_along(aim().position - pose.position), speed()};
    const bool aligned = std::isinf(swarm().max_turn_rate) ||
                         std::abs(wrap(command.heading - pose.heading)) < rounding;
    const double dt =
        aligned ? left / command.speed : std::min(lookahead_tick, left / command.speed);
    const Pose2 next = unicycle_step(pose, command, swarm().max_turn_rate, dt);
    const Segment move{pose.position, next.position};
    if (!world.map().is_free(move, from_walls)) return false;
    if (!world.moving().is_free(move, from_bodies)) return false;
    pose = next;
    left -= command.speed * dt;
  }
  return true;
}

}  // namespace microswarm::navigation
