// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// Parameters of the rollout planner. Work is counted in robot-steps: places moved, and 20 for the
/// rest of each simulated step; some 40 million a second on one core.
struct RolloutParams {
  static constexpr std::string_view type_name = "rollout";
  double budget = 4e6;
  double max_work = 200e6;
  int max_steps = 100'000;
  int representatives = 32;
  int lookahead_representatives = 64;
  int candidates = 16;
  int horizon = 150;
  int commit = 50;
  double max_deviation = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.budget, {"budget", Unit::none, {0, 1e12}, "Work of a decision, in robot-steps."});
    visit(self.max_work,
          {"max_work", Unit::none, {0, 1e15}, "Work on a better plan in all; 0: without end."});
    visit(self.max_steps,
          {"max_steps", Unit::none, {1, 1e8}, "Longest plan; its base is followed without one."});
    visit(self.representatives,
          {"places", Unit::none, {1, 1e6}, "Robots that stand for all when a variation is tried."});
    visit(self.lookahead_representatives, {"lookahead_places",
                                           Unit::none,
                                           {1, 1e6},
                                           "Robots that stand for all when it looks ahead."});
    visit(
        self.candidates,
        {"candidates", Unit::none, {0, 1e4}, "Leaders tried when it looks ahead; 0: it does not."});
    visit(self.horizon, {"horizon", Unit::none, {1, 1e6}, "Steps that it looks ahead."});
    visit(self.commit, {"commit", Unit::none, {1, 1e6}, "Steps after which it looks ahead anew."});
    visit(self.max_deviation, {"stray",
                               Unit::none,
                               {0, 1e6},
                               "Plans anew when robots are off by more steps on average."});
  }
};

}  // namespace microswarm
