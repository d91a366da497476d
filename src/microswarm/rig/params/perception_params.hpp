// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm {

/// Settings of the image processing of a rig.
struct PerceptionParams {
  SceneParams scene;
  ParticleParams robots{.min_mass = 500};
  double edge = 0;
  double heading_distance = 15;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scene, {"scene", Unit::none, {}, "Detection of a one-body swarm and of obstacles."});
    visit(self.robots, {"robots", Unit::none, {}, "Detection of individually tracked robots."});
    visit(self.edge,
          {"edge", Unit::px, {-1000, 1000}, "Width by which the swarm exceeds its outline."});
    visit(self.heading_distance, {"heading_distance",
                                  Unit::um,
                                  {1e-3, 1e5},
                                  "Distance travelled over which the heading is measured.",
                                  false,
                                  "heading_way_um"});
  }
};

}  // namespace microswarm
