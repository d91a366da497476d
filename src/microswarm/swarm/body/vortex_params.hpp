// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Vortex-like swarm under a rotating field [radar]. It moves in any direction at once, with a
/// speed given by the pitch of the field (Eq 2), and its radius changes while it moves. A command's
/// speed is converted to the pitch φ = speed / c with c = max_speed / max_pitch.
struct VortexParams {
  static constexpr std::string_view type_name = "vortex";
  double radius = 350;
  double moving_radius = 350;
  double radius_lag = 2;
  double radius_ripple = 0;
  double max_speed = 100;
  double max_pitch = radians(5);
  double response_lag = 0.1;
  double position_noise = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.radius, um("radius", 1e-3, 1e5, "Radius of the swarm at rest."));
    visit(self.moving_radius, um("moving_radius", 1e-3, 1e5, "Radius at the maximum speed."));
    visit(self.radius_lag, s("radius_lag", 1e-3, 1e3, "Time constant of the radius."));
    visit(self.radius_ripple,
          um("radius_ripple", 0, 1e4, "Standard deviation of the radius; at most twice that."));
    visit(self.max_speed, um_per_s("max_speed", 1e-3, 1e5, "Speed at the maximum pitch."));
    visit(self.max_pitch, deg("max_pitch", 1e-3, 90, "Largest stable pitch."));
    visit(self.response_lag, s("response_lag", 0, 10, "Dead time from a command to its effect."));
    visit(self.position_noise,
          um("position_noise", 0, 1e4, "Random drift, standard deviation after 1 s."));
  }
};

}  // namespace microswarm
