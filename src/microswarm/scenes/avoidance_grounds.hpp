// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/rng.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::scenes {

/// Where a swarm is to cross: walls, what belongs to them, start and goal.
struct Ground {
  PolygonsMap map;
  std::vector<Obstacle> fixtures;        ///< valves in gates, or the deforming channel
  std::vector<std::vector<Vec2>> lanes;  ///< along which movers go between walls; none in the open
  double extent = 90;                    ///< greatest radius around a mover [µm]
  double lane_room = 0;                  ///< least distance from a lane to the walls [µm]
  bool enclosed = false;                 ///< nothing comes from beyond the walls
  Vec2 start{};
  Vec2 goal{};
};

/// Half the width [µm] that a passage must have, and the swarm's speed [µm/s].
struct Crosser {
  double half_passage = 0;
  double speed = 0;
};

/// Nothing but a border; wide enough for `obstacles`.
Ground open_ground(const Crosser& swarm, int obstacles, Rng& rng);
/// Walls of all forms on it, each a passage away from the others.
Ground scattered_ground(const Crosser& swarm, int obstacles, Rng& rng);
/// Walls across with two gates each, some of them closed by valves at times.
Ground gated_ground(const Crosser& swarm, double speed_ratio, Rng& rng);
/// Vessels as src/microswarm/scenes/vascular draws them.
Ground vessel_ground(const Crosser& swarm, Rng& rng);
/// A channel whose walls are moving.
Ground channel_ground(const Crosser& swarm, double speed_ratio, Rng& rng);

}  // namespace microswarm::scenes
