// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// A simulated microscope with a camera: what it shows of a world, and how badly.
struct MicroscopeParams {
  std::optional<double> um_per_px;
  int margin = 16;
  double light = 180;
  double light_gradient = 0.15;
  double light_drift = 0.05;
  double light_period = 40;
  double noise = 3;
  double blur = 1;
  double wall_depth = 0.35;
  double obstacle_depth = 0.3;
  double swarm_depth = 0.65;
  double swarm_density = 2;
  double particle_diameter = 3;
  double robot_diameter = 7;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.um_per_px, {"um_per_px",
                           Unit::none,
                           {1e-3, 1e6},
                           "µm that a pixel shows; not given: the map's longer side has 800."});
    visit(self.margin,
          {"margin", Unit::px, {0, 1000}, "What is seen beyond the map, on every side."});
    visit(self.light, {"light", Unit::none, {0, 255}, "Grey of the bright ground."});
    visit(self.light_gradient, {"light_gradient",
                                Unit::none,
                                {0, 1},
                                "Brighter in one corner, darker in the other, by this share."});
    visit(self.light_drift,
          {"light_drift", Unit::none, {0, 1}, "The light swells and sinks by this share."});
    visit(self.light_period, {"light_period", Unit::s, {1e-2, 1e6}, "Time in which it does."});
    visit(self.noise, {"noise", Unit::none, {0, 255}, "Standard deviation of a pixel's grey."});
    visit(self.blur, {"blur", Unit::px, {0, 20}, "Spread of the picture of a point."});
    visit(self.wall_depth,
          {"wall_depth", Unit::none, {0, 1}, "Share of the light that walls take away."});
    visit(self.obstacle_depth,
          {"obstacle_depth", Unit::none, {0, 1}, "Share that obstacles take away."});
    visit(self.swarm_depth,
          {"swarm_depth", Unit::none, {0, 1}, "Share that one particle of a swarm takes away."});
    visit(self.swarm_density, {"swarm_density",
                               Unit::none,
                               {0.01, 10},
                               "Area of all its clumps of particles beside that of the swarm."});
    visit(self.particle_diameter,
          {"particle_diameter", Unit::px, {1, 100}, "Diameter of such a clump."});
    visit(self.robot_diameter,
          {"robot_diameter", Unit::px, {1, 100}, "Diameter of a robot that is told apart."});
  }
};

}  // namespace microswarm
