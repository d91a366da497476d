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
  double most_work = 200e6;
  int most_steps = 100'000;
  int places = 32;
  int lookahead_places = 64;
  int candidates = 16;
  int horizon = 150;
  int commit = 50;
  double stray = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.budget, {"budget", Unit::none, {0, 1e12}, "Work of a decision, in robot-steps."});
    visit(self.most_work,
          {"most_work", Unit::none, {0, 1e15}, "Work on a better plan in all; 0: without end."});
    visit(self.most_steps,
          {"most_steps", Unit::none, {1, 1e8}, "Longest plan; its base is followed without one."});
    visit(self.places,
          {"places", Unit::none, {1, 1e6}, "Robots that stand for all when a variation is tried."});
    visit(self.lookahead_places, {"lookahead_places",
                                  Unit::none,
                                  {1, 1e6},
                                  "Robots that stand for all when it looks ahead."});
    visit(
        self.candidates,
        {"candidates", Unit::none, {0, 1e4}, "Leaders tried when it looks ahead; 0: it does not."});
    visit(self.horizon, {"horizon", Unit::none, {1, 1e6}, "Steps that it looks ahead."});
    visit(self.commit, {"commit", Unit::none, {1, 1e6}, "Steps after which it looks ahead anew."});
    visit(self.stray, {"stray",
                       Unit::none,
                       {0, 1e6},
                       "Plans anew when robots are off by more steps on average."});
  }
};

}  // namespace microswarm
