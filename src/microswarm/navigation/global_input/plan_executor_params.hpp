// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/planning/global_input/global_search_params.hpp"

namespace microswarm::navigation {

/// Executes a plan for several robots under one input in closed loop; open loop, errors would
/// accumulate, as [global] notes. The goal tolerance is that of the planner.
struct PlanExecutorParams {
  /// A search that gives up after some seconds.
  static planning::GlobalSearchParams limited() {
    planning::GlobalSearchParams p;
    p.max_nodes = 2'000'000;
    return p;
  }

  static constexpr std::string_view type_name = "plan_player";
  double max_deviation = 3;
  int rejoin_candidates = 64;
  double retry_time = 10;
  planning::GlobalSearchParams planner = limited();
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.max_deviation,
          um("max_deviation", 0, 1e6, "Deviation from the plan above which it is left.")
              .formerly("stray_um"));
    visit(self.rejoin_candidates,
          plain("rejoin_candidates", 0, 1e6,
                "Nearest positions of the plan at which rejoining is tried."));
    visit(self.retry_time, s("retry_time", 0, 1e5, "Hold time after a search without a plan."));
    visit(self.planner, plain("planner", "Search for the inputs."));
  }
};

}  // namespace microswarm::navigation
