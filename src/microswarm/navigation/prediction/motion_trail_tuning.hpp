// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of MotionTrail::recurrence that rarely need a change.
struct RecurrenceTuning {
  double min_speed = 5;
  double min_age = 1;
  double min_reversed_time = 3;
  double max_time_offset = 0.12;
  double max_place_offset = 2;
  double max_velocity_offset = 0.05;
  double place_noise_gain = 3;
  double velocity_noise_gain = 20;
  double velocity_weight = 0.3;
  double min_improvement = 0.5;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.min_speed, um_per_s("min_speed", 1e-3, 1e5, "Speed below which a body rests."));
    visit(self.min_age, s("min_age", 1e-3, 1e3, "Minimum age of a recurrence."));
    visit(self.min_reversed_time,
          s("min_reversed_time", 0, 1e3, "Motion remembered before a reversed recurrence."));
    visit(self.max_time_offset,
          s("max_time_offset", 0, 60, "Maximum time from a frame to the recurrence."));
    visit(self.max_place_offset,
          um("max_place_offset", 0, 1e4, "Maximum difference of positions, besides the noise."));
    visit(self.max_velocity_offset,
          plain("max_velocity_offset", 0, 2,
                "Maximum difference of velocities, as a share of the speed."));
    visit(self.place_noise_gain,
          plain("place_noise_gain", 0, 100, "Noises added to the difference of positions."));
    visit(self.velocity_noise_gain,
          per_s("velocity_noise_gain", 0, 1e4, "Noises added to the difference of velocities."));
    visit(self.velocity_weight,
          s("velocity_weight", 0, 100, "Weight of the velocity against the position."));
    visit(self.min_improvement,
          um("min_improvement", 0, 1e4, "Smaller difference for which an older one is taken."));
  }
};

}  // namespace microswarm::navigation
