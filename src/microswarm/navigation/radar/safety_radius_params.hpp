// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

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
    visit(self.adaptive,
          {"adaptive", Unit::none, {}, "Shrink the safety circle while obstacles are far."});
    visit(self.horizon, {"horizon", Unit::none, {1, 1e4}, "Number of steps ahead (N)."});
    visit(self.sample_time, {"sample_time", Unit::s, {1e-4, 1e3}, "Length of a step (T)."});
    visit(self.max_relative_speed, {"max_relative_speed",
                                    Unit::um_per_s,
                                    {0, 1e5},
                                    "Assumed maximum approach speed (|v_r|max)."});
    visit(self.assumed_time,
          {"assumed_time", Unit::s, {0, 1e3}, "Assumed duration of the approach (t_as)."});
    visit(self.collision_weight,
          {"collision_weight", Unit::none, {0, 1e9}, "Weight of the distance (Q)."});
    visit(self.speed_weight, {"speed_weight", Unit::none, {1e-9, 1e9}, "Weight of the speed (R)."});
  }
};

}  // namespace microswarm
