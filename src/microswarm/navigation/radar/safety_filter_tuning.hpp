// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/prediction/convex_outline_tuning.hpp"

namespace microswarm::navigation {

/// Constants of SafetyFilter that rarely need a change.
struct SafetyFilterTuning {
  double recovery_rate = 5;
  double counted_gap = 30;
  double gap_tolerance = 0.5;
  double contact_gap = 1;
  double contact_gap_rate = 1;
  double growth_time = 1;
  double max_dead_time = 0.5;
  std::vector<double> hold_times{0.5, 1};
  std::vector<double> run_times{0.5, 1, 2};
  std::vector<double> turn_times{0.4, 1};
  double switch_time = 0.25;
  double switch_gap = 5;
  int refinement = 2;
  int min_escapes = 4;
  double impatience = 0.25 * pi;
  ConvexOutlineTuning outline{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.recovery_rate,
          um_per_s("recovery_rate", 0, 1e5, "Rate at which a gap that is too small must grow."));
    visit(self.counted_gap,
          um("counted_gap", 0, 1e5, "Gap above which two escapes are equally good."));
    visit(self.gap_tolerance,
          um("gap_tolerance", 0, 1e4, "Difference of gaps below which escapes are equal."));
    visit(self.contact_gap, um("contact_gap", 0, 1e4, "Gap of a contact, for the best escape."));
    visit(self.contact_gap_rate,
          um_per_s("contact_gap_rate", 0, 1e4, "Growth of the contact gap with prediction time."));
    visit(self.growth_time,
          s("growth_time", 0, 60, "Time for which an outline keeps growing as observed."));
    visit(self.max_dead_time,
          s("max_dead_time", 0, 60, "Maximum time from a frame to the effect of a command."));
    visit(self.hold_times, s("hold_times", 0, 60, "Durations of a hold before an escape."));
    visit(self.run_times, s("run_times", 0, 60, "Durations of a run before a hold."));
    visit(self.turn_times, s("turn_times", 0, 60, "Durations of a run before another direction."));
    visit(self.switch_time,
          s("switch_time", 0, 60, "Extra free time for which an escape is replaced."));
    visit(self.switch_gap, um("switch_gap", 0, 1e5, "Extra gap for which an escape is replaced."));
    visit(self.refinement,
          plain("refinement", 1, 20, "Directions of a replacement per escape heading."));
    visit(self.min_escapes,
          plain("min_escapes", 1, 360, "Number of escapes a replacement must leave."));
    visit(self.impatience, deg_per_s("impatience", 0, 3600, "Growth of the cost of a hold."));
    visit(self.outline, plain("outline", "Use of convex hulls of obstacles."));
  }
};

}  // namespace microswarm::navigation
