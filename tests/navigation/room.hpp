// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "microswarm/navigation/steering/task.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::navigation {

/// A room of 2000 µm × 1000 µm and where swarms go in it.
inline Snapshot room_with(std::vector<Polygon> walls = {}, std::vector<Body> bodies = {}) {
  return Snapshot(std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, std::move(walls)), 0,
                  std::move(bodies));
}
inline constexpr Vec2 room_goal{1800, 500};
inline constexpr double room_tolerance = 30;

/// A task of a single-body swarm.
inline Task body_task(const SwarmLimits& swarm, Vec2 goal = room_goal,
                      double goal_tolerance = room_tolerance) {
  return {.swarm = swarm, .goal = goal, .goal_tolerance = goal_tolerance};
}

}  // namespace microswarm::navigation
