// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Adaptation of the safety circle, which shrinks while obstacles are far: model predictive
/// control, Eq 18–24 [radar].
struct SafetyRadiusParams {
  bool adaptive = false;
  int horizon = 10;                // N
  double sample_time = 0.1;        // T
  double max_relative_speed = 25;  // |v_r|max
  double assumed_time = 1;         // t_as
  double collision_weight = 1;     // Q
  double speed_weight = 1;         // R
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.adaptive, plain("adaptive", "Shrink the safety circle while obstacles are far."));
    visit(self.horizon, plain("horizon", 1, 1e4, "Number of steps ahead (N)."));
    visit(self.sample_time, s("sample_time", 1e-4, 1e3, "Length of a step (T)."));
    visit(self.max_relative_speed,
          um_per_s("max_relative_speed", 0, 1e5, "Assumed maximum approach speed (|v_r|max)."));
    visit(self.assumed_time, s("assumed_time", 0, 1e3, "Assumed duration of the approach (t_as)."));
    visit(self.collision_weight, plain("collision_weight", 0, 1e9, "Weight of the distance (Q)."));
    visit(self.speed_weight, plain("speed_weight", 1e-9, 1e9, "Weight of the speed (R)."));
  }
};

}  // namespace microswarm::navigation
