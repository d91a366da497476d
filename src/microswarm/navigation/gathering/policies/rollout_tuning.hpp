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
  }
};

}  // namespace microswarm
