// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/swarm/robots/contact_rule.hpp"

namespace microswarm::planning {

/// Parameters of global_rrt. `goal_bias` and `separation` go beyond the paper, whose tree has no
/// goal.
struct GlobalRrtParams {
  static constexpr std::string_view type_name = "global_rrt";
  double robostep = 5;
  int directions = 16;  // k
  ContactRule contact = ContactRule::slide;
  double goal_tolerance = 20;
  double goal_bias = 0;
  double separation = 0;
  int max_nodes = 40'000;  // K
  int max_iterations = 100'000'000;
  bool stop_at_first = true;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.robostep, um("robostep", 1e-3, 1e6, "Length of one input."));
    visit(self.directions,
          plain("directions", 3, 256, "Number of input directions, from the x axis (k)."));
    visit(self.contact, plain("contact", "Behaviour of a robot that meets a wall."));
    visit(self.goal_tolerance,
          um("goal_tolerance", 1e-3, 1e6, "Distance from its goal that each robot must reach."));
    visit(self.goal_bias, plain("goal_bias", 0, 1, "Share of samples at the goals."));
    visit(self.separation, um("separation", 0, 1e6, "Minimum distance between robots; 0: none."));
    visit(self.max_nodes, plain("max_nodes", 1, 1e8, "Maximum number of nodes (K)."));
    visit(self.max_iterations, plain("max_iterations", 1, 1e9, "Maximum number of iterations."));
    visit(self.stop_at_first,
          plain("stop_at_first", "Stop at the first solution; else grow to the limits."));
  }
};

}  // namespace microswarm::planning
