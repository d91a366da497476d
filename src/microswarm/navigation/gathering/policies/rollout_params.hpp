// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/gathering/policies/rollout_tuning.hpp"

namespace microswarm::navigation {

/// Parameters of the rollout planner. Work is counted in robot-steps: positions moved, plus 20 for
/// the rest of each simulated step. One core does 50 to 110 million per second.
struct RolloutParams {
  static constexpr std::string_view type_name = "rollout";
  double budget = 4e6;
  double first_budget = 20e6;
  double max_work = 200e6;
  int max_steps = 100'000;
  int representatives = 32;
  int lookahead_representatives = 256;
  int candidates = 8;
  int horizon = 80;
  int layer_width = 30;
  double max_deviation = 1;
  int threads = 1;
  RolloutTuning tuning{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.budget, plain("budget", 0, 1e12, "Simulated robot-steps per decision."));
    visit(self.first_budget,
          plain("first_budget", 0, 1e12, "The same before the robots move at all."));
    visit(self.max_work,
          plain("max_work", 0, 1e15, "Robot-steps spent on better plans; 0: unlimited.")
              .formerly("most_work"));
    visit(self.max_steps,
          plain("max_steps", 1, 1e8, "Longest plan; beyond it the base policy is followed.")
              .formerly("most_steps"));
    visit(self.representatives,
          plain("representatives", 1, 1e6, "Representative robots for trying a variation.")
              .formerly("places"));
    visit(self.lookahead_representatives,
          plain("lookahead_representatives", 1, 1e6, "Representative robots for the lookahead.")
              .formerly("lookahead_places"));
    visit(self.candidates,
          plain("candidates", 0, 1e4, "Trials of a state; 0: no search by layers."));
    visit(self.horizon, plain("horizon", 1, 1e6, "Maximum number of steps of a trial."));
    visit(self.layer_width, plain("layer_width", 1, 1e6, "States kept after equally many steps."));
    visit(self.max_deviation,
          plain("max_deviation", 0, 1e6, "Mean deviation in steps above which it plans again.")
              .formerly("stray"));
    visit(self.threads, plain("threads", 0, 1024, "Threads of the search; 0: one per core."));
    visit(self.tuning, plain("tuning", "Constants that rarely need a change."));
  }
};

}  // namespace microswarm::navigation
