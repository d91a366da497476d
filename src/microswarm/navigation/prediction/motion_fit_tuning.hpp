// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of fit_motion that rarely need a change.
struct MotionFitTuning {
  double min_noise = 0.02;
  double initial_noise = 0.5;
  int min_noise_sightings = 7;
  double max_residual = 3;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.min_noise, um("min_noise", 1e-6, 1e4, "Lower bound of the estimated noise."));
    visit(self.initial_noise,
          um("initial_noise", 1e-6, 1e4, "Noise assumed before it can be estimated."));
    visit(self.min_noise_sightings,
          plain("min_noise_sightings", 4, 100,
                "Number of sightings from which the noise is estimated."));
    visit(self.max_residual, plain("max_residual", 0, 100,
                                   "Root mean square residual that ends a window, in noises."));
  }
};

}  // namespace microswarm::navigation
