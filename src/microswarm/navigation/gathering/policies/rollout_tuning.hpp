// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of the rollout policy that rarely need a change.
struct RolloutTuning {
  std::vector<int> change_lengths{5, 10, 20, 40, 80};
  int replan_representatives = 64;
  double finest_cell = 0.25;
  double merge_cell = 0.5;
  double robots_exponent = 0.3;
  double step_overhead = 20;
  int states_per_layer = 1;
  int min_passes = 1;
  int min_trial = 4;
  double direction_share = 0.4;
  double head_start = 0.02;
  double layers_work = 8e6;
  double changes_work = 8e6;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.change_lengths,
          plain("change_lengths", 1, 1e6, "Lengths of a random change, in steps."));
    visit(self.replan_representatives,
          plain("replan_representatives", 1, 1e6, "Representative robots for replanning."));
    visit(self.finest_cell,
          plain("finest_cell", 1e-3, 1e3, "Initial cell of merged robots, in steps."));
    visit(self.merge_cell,
          plain("merge_cell", 1e-3, 1e3, "Robots this near are led together, in steps."));
    visit(self.robots_exponent,
          plain("robots_exponent", 0, 4, "Exponent of the robots at a place to lead."));
    visit(self.step_overhead,
          plain("step_overhead", 0, 1e6, "Cost of a step besides its robots, in robots."));
    visit(self.states_per_layer,
          plain("states_per_layer", 1, 1e4, "States of a layer expanded at once."));
    visit(self.min_passes, plain("min_passes", 0, 1e6, "Fewest passes over all layers."));
    visit(self.min_trial,
          plain("min_trial", 1, 1e6, "Fewest steps of a trial in the search by layers."));
    visit(self.direction_share,
          plain("direction_share", 0, 1, "Share of trials in which all go in one direction."));
    visit(self.head_start, plain("head_start", 0, 1, "Share of the plan that layers begin ahead."));
    visit(self.layers_work, plain("layers_work", 0, 1e15, "Robot-steps of a search by layers."));
    visit(self.changes_work,
          plain("changes_work", 0, 1e15, "Robot-steps of random changes after layers."));
  }
};

}  // namespace microswarm::navigation
