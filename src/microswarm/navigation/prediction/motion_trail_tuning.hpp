// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// Constants of MotionTrail::recurrence that seldom need a change.
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
    visit(self.min_speed,
          {"min_speed", Unit::um_per_s, {1e-3, 1e5}, "Speed below which a body rests."});
    visit(self.min_age, {"min_age", Unit::s, {1e-3, 1e3}, "Minimum age of a recurrence."});
    visit(self.min_reversed_time, {"min_reversed_time",
                                   Unit::s,
                                   {0, 1e3},
                                   "Motion remembered before a reversed recurrence."});
    visit(self.max_time_offset,
          {"max_time_offset", Unit::s, {0, 60}, "Maximum time from a frame to the recurrence."});
    visit(self.max_place_offset, {"max_place_offset",
                                  Unit::um,
                                  {0, 1e4},
                                  "Maximum difference of positions, besides the noise."});
    visit(self.max_velocity_offset, {"max_velocity_offset",
                                     Unit::none,
                                     {0, 2},
                                     "Maximum difference of velocities, as a share of the speed."});
    visit(
        self.place_noise_gain,
        {"place_noise_gain", Unit::none, {0, 100}, "Noises added to the difference of positions."});
    visit(self.velocity_noise_gain, {"velocity_noise_gain",
                                     Unit::per_s,
                                     {0, 1e4},
                                     "Noises added to the difference of velocities."});
    visit(self.velocity_weight,
          {"velocity_weight", Unit::s, {0, 100}, "Weight of the velocity against the position."});
    visit(self.min_improvement, {"min_improvement",
                                 Unit::um,
                                 {0, 1e4},
                                 "Smaller difference for which an older one is taken."});
  }
};

}  // namespace microswarm
