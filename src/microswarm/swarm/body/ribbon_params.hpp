// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Ribbon-like swarm under an oscillating field, modelled as a unicycle [drrt]: it turns towards
/// the commanded heading at a limited rate and moves along its own heading.
struct RibbonParams {
  static constexpr std::string_view type_name = "ribbon";
  double radius = 40;
  double max_speed = 80;
  double max_turn_rate = 3;
  double response_lag = 0.1;
  double position_noise = 0;
  double heading_noise = 0;
  Vec2 drift{};
  double speed_factor = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.radius, um("radius", 1e-3, 1e5, "Radius of the swarm's body."));
    visit(self.max_speed, um_per_s("max_speed", 1e-3, 1e5, "Maximum speed."));
    visit(self.max_turn_rate, deg_per_s("max_turn_rate", 1e-3, 36000, "Maximum turn rate."));
    visit(self.response_lag, s("response_lag", 0, 10, "Dead time from a command to its effect."));
    visit(self.position_noise,
          um("position_noise", 0, 1e4, "Random drift, standard deviation after 1 s."));
    visit(self.heading_noise,
          deg("heading_noise", 0, 360, "Random turning, standard deviation after 1 s."));
    visit(self.drift,
          um_per_s("drift", -1e5, 1e5, "Flow that carries the swarm; hidden from navigators."));
    visit(self.speed_factor,
          plain("speed_factor", 0, 10, "Actual over commanded speed; hidden from navigators."));
  }
};

}  // namespace microswarm
