// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of MotionModels that rarely need a change.
struct MotionModelsTuning {
  int min_curved_frames = 5;
  double acceleration_time = 1;
  double turning_time = 1;
  int explained_frames = 3;
  double max_offset = 0.3;
  double noise_gain = 3;
  double circle_offset = 1;
  double max_circle_radius = 5000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.min_curved_frames, plain("min_curved_frames", 1, 100,
                                        "Number of frames from which acceleration is believed."));
    visit(self.acceleration_time,
          s("acceleration_time", 0, 60, "Time for which an acceleration is assumed to last."));
    visit(self.turning_time,
          s("turning_time", 0, 60, "Time for which a rotation is assumed to last."));
    visit(self.explained_frames,
          plain("explained_frames", 1, 100, "Number of newest frames a swing must match."));
    visit(self.max_offset,
          um("max_offset", 0, 1e4, "Maximum difference from a swing, besides the noise."));
    visit(self.noise_gain,
          plain("noise_gain", 0, 100, "Noises added to the difference from a swing."));
    visit(self.circle_offset,
          um("circle_offset", 0, 1e4, "Distance from a circle, besides twice the swing's."));
    visit(self.max_circle_radius,
          um("max_circle_radius", 1, 1e7, "Radius above which a circle is a line."));
  }
};

}  // namespace microswarm::navigation
