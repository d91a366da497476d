// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of OscillationFit that rarely need a change. Windows and frequencies must ascend.
struct OscillationTuning {
  double short_window = 1.2;
  double medium_window = 3;
  double long_window = 8;
  double min_frequency = 0.08;
  double max_frequency = 3.5;
  double frame_spacing = 0.08;
  int min_sightings = 6;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.short_window, s("short_window", 0.1, 60, "Shortest time that is fitted."));
    visit(self.medium_window,
          s("medium_window", 0.1, 60, "Time fitted between the shortest and longest."));
    visit(self.long_window, s("long_window", 0.1, 60, "Longest time that is fitted."));
    visit(self.min_frequency,
          per_s("min_frequency", 1e-3, 1e3, "Lowest angular frequency, in rad/s."));
    visit(self.max_frequency,
          per_s("max_frequency", 1e-3, 1e3, "Highest angular frequency, in rad/s."));
    visit(self.frame_spacing,
          s("frame_spacing", 0.01, 10, "Minimum time between frames that are used."));
    visit(self.min_sightings,
          plain("min_sightings", 3, 1000, "Number of sightings that a window needs."));
  }
};

}  // namespace microswarm::navigation
