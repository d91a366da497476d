// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// How the safety circle narrows while obstacles are far: model predictive control, Eq 18–24
/// [radar].
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
          {"adaptive", Unit::none, {}, "Narrow the safety circle while obstacles are far."});
    visit(self.horizon, {"horizon", Unit::none, {1, 1e4}, "Steps looked ahead (N)."});
    visit(self.sample_time, {"sample_time", Unit::s, {1e-4, 1e3}, "Length of a step (T)."});
    visit(self.max_relative_speed, {"max_relative_speed",
                                    Unit::um_per_s,
                                    {0, 1e5},
                                    "Fastest approach that is assumed (|v_r|max)."});
    visit(self.assumed_time,
          {"assumed_time", Unit::s, {0, 1e3}, "How long it is assumed to come nearer (t_as)."});
    visit(self.collision_weight,
          {"collision_weight", Unit::none, {0, 1e9}, "Weight of the distance (Q)."});
    visit(self.speed_weight, {"speed_weight", Unit::none, {1e-9, 1e9}, "Weight of the speed (R)."});
  }
};

/// The controller with these parameters; see safety_radius.cpp for why it is exact.
class SafetyRadius {
 public:
  explicit SafetyRadius(const SafetyRadiusParams& params);

  /// |v_ropt| [µm/s], the first input that minimises Eq 23, of an obstacle whose edge is `gap` µm
  /// from the swarm's.
  double assumed_speed(double gap) const;
  /// r_f [µm], Eq 24: at most `greatest` (r_f0), at least `least` (the prediction circle). Of
  /// several obstacles the nearest one's gap gives the largest, hence theirs all.
  double radius(double greatest, double least, double gap) const;

 private:
  SafetyRadiusParams params_;
  double gain_ = 0;  // K_0 [1/s]
};

}  // namespace microswarm
