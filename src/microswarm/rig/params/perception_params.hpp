// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"
#include "microswarm/vision/scene/wall_finder.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::rig {

/// Settings of the image processing of a rig.
struct PerceptionParams {
  vision::SceneParams scene{};
  vision::ParticleParams robots{.min_mass = 500};
  double edge = 0;
  double heading_distance = 15;
  double speed_gain = 2;
  double position_noise = 8;
  double radius_tolerance = 0.35;
  double min_seen_robots = 0.5;
  bool start_anywhere = false;
  bool moving_walls = false;
  vision::WallParams walls{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scene, plain("scene", "Detection of a one-body swarm and of obstacles."));
    visit(self.robots, plain("robots", "Detection of individually tracked robots."));
    visit(self.edge, px("edge", -1000, 1000, "Width by which the swarm exceeds its outline."));
    visit(self.heading_distance, um("heading_distance", 1e-3, 1e5,
                                    "Distance travelled over which the heading is measured.")
                                     .formerly("heading_way_um"));
    visit(self.speed_gain,
          plain("speed_gain", 1, 100, "Speed at which a swarm is searched, in maximum speeds."));
    visit(self.position_noise,
          px("position_noise", 0, 1e4, "Distance at which it is searched, besides its motion."));
    visit(self.radius_tolerance, plain("radius_tolerance", 0.01, 100,
                                       "Maximum relative deviation from its median radius."));
    visit(self.min_seen_robots,
          plain("min_seen_robots", 0, 1, "Share of the robots that must be seen."));
    visit(self.start_anywhere,
          plain("start_anywhere", "A swarm that is not near its start may be anywhere."));
    visit(self.moving_walls, plain("moving_walls", "Walls move: they are found in every picture."));
    visit(self.walls, plain("walls", "Appearance of walls that move."));
  }
};

}  // namespace microswarm::rig
