// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/perception.hpp"

#include <algorithm>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/rig/perception/robot_perception.hpp"
#include "microswarm/rig/perception/swarm_perception.hpp"

namespace microswarm::rig {

namespace {

/// Whether walls around the swarm move.
bool shows_channel(const std::vector<Obstacle>& obstacles) {
  return std::ranges::any_of(obstacles, [](const Obstacle& obstacle) {
    return std::visit(
        Overloaded{[](const DeformingChannel&) { return true; },
                   [](const OneOf<DiscShape, BreathingDisc, BoxShape, PolygonShape, Valve> auto&) {
                     return false;
                   }},
        obstacle.shape);
  });
}

}  // namespace

Observation to_observation(const Detections& sight, std::shared_ptr<const Snapshot> world,
                           double now, double seen) {
  Observation observation{.now = now,
                          .seen = seen,
                          .swarm = sight.swarm,
                          .robots = {},
                          .unseen = sight.unseen,
                          .world = std::move(world)};
  if (sight.swarm) observation.robots = sight.robots;
  return observation;
}

std::unique_ptr<Perception> make_perception(const PerceptionParams& params,
                                            const experiment::Scenario& scenario, const Map& map,
                                            std::span<const Vec2> starts, const CameraView& view) {
  if (scenario.robots)
    return std::make_unique<RobotPerception>(params, *scenario.robots, map, starts, view);
  PerceptionParams shown = params;
  shown.moving_walls = params.moving_walls || shows_channel(scenario.obstacles);
  return std::make_unique<SwarmPerception>(shown, swarm_limits(scenario.swarm), map,
                                           *scenario.start, view, scenario.obstacles);
}

}  // namespace microswarm::rig
