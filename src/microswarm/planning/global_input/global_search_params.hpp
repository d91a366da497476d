// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/swarm/robots/contact_rule.hpp"

namespace microswarm::planning {

/// Parameters of the search beyond [global]. One set does for two to four robots.
struct GlobalSearchParams {
  static constexpr std::string_view type_name = "global_search";
  double robostep = 5;
  int directions = 8;
  ContactRule contact = ContactRule::slide;
  double goal_tolerance = 20;
  double cell = 0;
  double noise = 0.8;
  double travel_weight = 0.2;
  double separation = 0;
  int round_nodes = 15'000;
  int max_nodes = 100'000'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.robostep, um("robostep", 1e-3, 1e6, "Length of one input."));
    visit(self.directions,
          plain("directions", 3, 256, "Number of input directions, from the x axis."));
    visit(self.contact, plain("contact", "Behaviour of a robot that meets a wall."));
    visit(self.goal_tolerance,
          um("goal_tolerance", 1e-3, 1e6, "Distance from its goal that each robot must reach."));
    visit(self.cell, um("cell", 0, 1e6, "Edge of the hypercubes; 0: 2.25 goal tolerances."));
    visit(self.noise, plain("noise", 0, 10, "Random share added to the cost of a node."));
    visit(self.travel_weight, plain("travel_weight", 0, 1e3,
                                    "Weight of the common travel against the formation error."));
    visit(self.separation, um("separation", 0, 1e6, "Minimum distance between robots; 0: none."));
    visit(self.round_nodes,
          plain("round_nodes", 1, 1e8, "Number of nodes after which the first round restarts."));
    visit(self.max_nodes, plain("max_nodes", 1, 2e9, "Maximum number of nodes over all rounds."));
  }
};

}  // namespace microswarm::planning
