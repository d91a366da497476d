// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// Constants of the rollout policy that seldom need a change.
struct RolloutTuning {
  std::vector<int> change_lengths{5, 10, 20, 40, 80};
  int replan_representatives = 64;
  double finest_cell = 0.25;
  double merge_cell = 0.5;
  double robots_exponent = 0.3;
  double step_overhead = 20;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.change_lengths,
          {"change_lengths", Unit::none, {1, 1e6}, "Lengths of a random change, in steps."});
    visit(self.replan_representatives, {"replan_representatives",
                                        Unit::none,
                                        {1, 1e6},
                                        "Representative robots when it plans anew."});
    visit(self.finest_cell,
          {"finest_cell", Unit::none, {1e-3, 1e3}, "Initial cell of merged robots, in steps."});
    visit(self.merge_cell,
          {"merge_cell", Unit::none, {1e-3, 1e3}, "Robots this near are led together, in steps."});
    visit(self.robots_exponent,
          {"robots_exponent", Unit::none, {0, 4}, "Exponent of the robots at a place to lead."});
    visit(self.step_overhead,
          {"step_overhead", Unit::none, {0, 1e6}, "Cost of a step besides its robots, in robots."});
  }
};

}  // namespace microswarm
