// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::experiment {

/// A planner as stored in a file, so that --set planner.… works as in scenarios; `Planners` is a
/// variant.
template <class Planners>
struct PlannerChoice {
  Planners planner{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.planner, plain("planner", "Planner and its parameters."));
  }
};

}  // namespace microswarm::experiment
