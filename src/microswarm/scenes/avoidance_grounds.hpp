// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::scenes {

/// Environment of an avoidance scenario: walls and their fixtures, start and goal.
struct Ground {
  formats::PolygonsMap map{};
  std::vector<Obstacle> fixtures{};        ///< valves in gates, or the deforming channel
  std::vector<std::vector<Vec2>> lanes{};  ///< paths of movers between walls; empty in the open
  double extent = 90;                      ///< maximum radius of a mover [µm]
  double lane_room = 0;                    ///< minimum distance from a lane to the walls [µm]
  bool enclosed = false;                   ///< nothing enters from beyond the walls
  Vec2 start{};
  Vec2 goal{};
};

/// Required half width of a passage [µm] and the swarm's speed [µm/s].
struct Crosser {
  double half_passage = 0;
  double speed = 0;
};

/// Open area with only a border, large enough for `obstacles`.
Ground open_ground(const Crosser& swarm, int obstacles, Rng& rng);
/// Scattered walls of all shapes, each at least a passage away from the others.
Ground scattered_ground(const Crosser& swarm, int obstacles, Rng& rng);
/// Transverse walls with two gates each, some of them closed at times by valves.
Ground gated_ground(const Crosser& swarm, double speed_ratio, Rng& rng);
/// A thick wall across with two lanes through it, `half_width` [µm].
Ground narrow_ground(const Crosser& swarm, double half_width, Rng& rng);
/// A wall across with two gates, one of them shut by a disc that rests in it.
Ground blocked_ground(const Crosser& swarm, Rng& rng);
/// One or two pockets, about on the straight way, that open towards the start.
Ground dead_end_ground(const Crosser& swarm, Rng& rng);
/// Vessels as drawn by scenes/vascular.
Ground vessel_ground(const Crosser& swarm, Rng& rng);
/// A channel with moving walls.
Ground channel_ground(const Crosser& swarm, double speed_ratio, Rng& rng);

}  // namespace microswarm::scenes
