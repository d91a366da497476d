// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm {

/// How a rig reads its pictures.
struct PerceptionParams {
  SceneParams scene;
  ParticleParams robots{.min_mass = 500};
  double edge = 0;
  double heading_distance = 15;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scene,
          {"scene", Unit::none, {}, "How a swarm that is one body and obstacles are found."});
    visit(self.robots, {"robots", Unit::none, {}, "How robots that are told apart are found."});
    visit(self.edge,
          {"edge", Unit::px, {-1000, 1000}, "The swarm reaches beyond its outline by this."});
    visit(self.heading_distance,
          {"heading_way", Unit::um, {1e-3, 1e5}, "Way from which the swarm's heading is told."});
  }
};

}  // namespace microswarm
