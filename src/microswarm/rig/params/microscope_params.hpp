// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::rig {

/// Settings of a simulated microscope camera: scale, light, noise, contrasts, and faults.
struct MicroscopeParams {
  std::optional<double> um_per_px{};
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
  Vec2 shift_px{};
  double turn = 0;
  double scale_error = 0;
  double moved_after = 0;
  std::optional<double> frozen_after{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.um_per_px,
          plain("um_per_px", 1e-3, 1e6, "Scale; none: the map's longer side has 800 px."));
    visit(self.margin, px("margin", 0, 1000, "Border seen around the map."));
    visit(self.light, plain("light", 0, 255, "Grey value of the bright background."));
    visit(self.light_gradient,
          plain("light_gradient", 0, 1, "Relative brightness change from corner to corner."));
    visit(self.light_drift,
          plain("light_drift", 0, 1, "Relative amplitude of slow brightness changes."));
    visit(self.light_period, s("light_period", 1e-2, 1e6, "Period of slow brightness changes."));
    visit(self.noise, plain("noise", 0, 255, "Standard deviation of a pixel's grey value."));
    visit(self.blur, px("blur", 0, 20, "Standard deviation of the image of a point."));
    visit(self.wall_depth, plain("wall_depth", 0, 1, "Share of the light absorbed by walls."));
    visit(self.obstacle_depth,
          plain("obstacle_depth", 0, 1, "Share of the light absorbed by obstacles."));
    visit(self.swarm_depth,
          plain("swarm_depth", 0, 1, "Share of the light absorbed by one swarm particle."));
    visit(self.swarm_density,
          plain("swarm_density", 0.01, 10, "Area of all particle clumps over that of the swarm."));
    visit(self.particle_diameter, px("particle_diameter", 1, 100, "Diameter of a particle clump."));
    visit(self.robot_diameter,
          px("robot_diameter", 1, 100, "Diameter of an individually tracked robot."));
    visit(self.shift_px, px("shift", -1e4, 1e4, "Displacement that the rig does not know of."));
    visit(self.turn, deg("turn", -180, 180, "Clockwise turn that the rig does not know of."));
    visit(self.scale_error,
          plain("scale_error", -0.9, 10, "Relative excess of all sizes, not known, either."));
    visit(self.moved_after, s("moved_after", 0, 1e6, "Time from which these three hold."));
    visit(self.frozen_after,
          s("frozen_after", 0, 1e6, "Time from which only light and noise change; none: never."));
  }
};

}  // namespace microswarm::rig
