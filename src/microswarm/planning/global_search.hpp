// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/planning/global_tree.hpp"
#include "microswarm/planning/plan.hpp"

namespace microswarm {

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
    visit(self.robostep, {"robostep", Unit::um, {1e-3, 1e6}, "Length of one input."});
    visit(self.directions,
          {"directions", Unit::none, {3, 256}, "Directions of inputs, from the x axis on."});
    visit(self.contact, {"contact", Unit::none, {}, "What a robot does that meets a wall."});
    visit(self.goal_tolerance,
          {"goal_tolerance", Unit::um, {1e-3, 1e6}, "How near every robot must come to its goal."});
    visit(self.cell,
          {"cell", Unit::um, {0, 1e6}, "Edge of the hypercubes; 0 chooses 2.25 goal tolerances."});
    visit(self.noise, {"noise", Unit::none, {0, 10}, "Random share added to a node's cost."});
    visit(self.travel_weight, {"travel_weight",
                               Unit::none,
                               {0, 1e3},
                               "Cost of the way the swarm has to go as a whole, "
                               "against that of a wrong formation."});
    visit(self.separation,
          {"separation", Unit::um, {0, 1e6}, "Least distance between robots; 0: none."});
    visit(self.round_nodes,
          {"round_nodes", Unit::none, {1, 1e8}, "Nodes after which the first round starts anew."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 2e9}, "Nodes of all rounds at most."});
  }
};

/// A plan and what it took.
struct GlobalSearch {
  GlobalPlan plan;
  /// iterations: nodes expanded; samples: nodes made; edge_checks: inputs tried
  PlanCounts counts;
  int rounds = 0;
};

/// Best-first search for inputs that bring robots to their goals under one input; beyond [global],
/// whose tree seldom gets three robots anywhere. An input is held until nothing moves any more, and
/// every place on the way where a robot comes to a wall or leaves it is a node, so that walls and
/// corners are used on purpose. A node's cost is how wrong the robots stand to each other, which
/// walls alone can mend, and a little of the way they have to go together. Robots that have met at
/// one spot can never be parted again: unless a place serves both their goals, that is no node. Of
/// the configurations in one hypercube only the first is kept. That and a little noise in the costs
/// make it quick and incomplete: after some nodes it starts anew with other hypercubes, each time a
/// little later, and in every other round it measures the way together around the walls instead of
/// straight. A pure function of its arguments. The status is start_blocked, goal_blocked, solved,
/// node_limit, or stopped or time_limit when it was told to stop; the plan then leads to the best
/// configuration that was seen. Throws InputError as global_rrt does, and when there are no goals.
GlobalSearch global_search(const Map& map, std::span<const Vec2> starts,
                           std::span<const Vec2> goals, const GlobalSearchParams& params, Rng& rng,
                           const Stop& stop = {});

}  // namespace microswarm
