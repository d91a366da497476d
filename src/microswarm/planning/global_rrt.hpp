// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/planning/global_tree.hpp"
#include "microswarm/planning/plan.hpp"

namespace microswarm {

/// `goal_bias` and `separation` go beyond the paper, whose tree knows no goal.
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
    visit(self.robostep, {"robostep", Unit::um, {1e-3, 1e6}, "Length of one input."});
    visit(self.directions,
          {"directions", Unit::none, {3, 256}, "Directions of inputs, from the x axis on (k)."});
    visit(self.contact, {"contact", Unit::none, {}, "What a robot does that meets a wall."});
    visit(self.goal_tolerance,
          {"goal_tolerance", Unit::um, {1e-3, 1e6}, "How near every robot must come to its goal."});
    visit(self.goal_bias, {"goal_bias", Unit::none, {0, 1}, "Share of samples at the goals."});
    visit(self.separation,
          {"separation", Unit::um, {0, 1e6}, "Least distance between robots; 0: none."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 1e8}, "Nodes to grow at most (K)."});
    visit(self.max_iterations, {"max_iterations", Unit::none, {1, 1e9}, "Tries at most."});
    visit(self.stop_at_first,
          {"stop_at_first", Unit::none, {}, "Stop at the first solution, or grow to the limits."});
  }
};

/// A grown tree and its answer to the goals it was grown with.
struct GlobalRrt {
  GoalAnswer answer;
  GlobalTree tree;
  PlanCounts counts;
};

/// Grows the tree of RRT under one input for all robots (Alg 1, 2 [global]): where the robots get
/// by the input of k that brings them nearest to a random free configuration; an input that moves
/// no robot adds no node. Without goals the tree grows to its limits, to be asked later. A pure
/// function of its arguments. The answer's status is start_blocked
/// (no tree then; robots nearer to each other than the separation are that too) or goal_blocked
/// (just the root), solved, node_limit, and stopped or time_limit
/// when it was told to stop; its node is the best there is. Throws InputError when there are no
/// robots, more than most_global_robots, or goals that are not as many.
GlobalRrt global_rrt(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                     const GlobalRrtParams& params, Rng& rng, const Stop& stop = {});

/// What is wrong before any planning: start_blocked (in a wall, or two robots nearer than
/// `separation`), goal_blocked (no free spot within the tolerance of a goal, or two goals so near
/// that no spots are far enough apart) or nothing.
std::optional<Status> robots_fault(const Map& map, std::span<const Vec2> starts,
                                   std::span<const Vec2> goals, double tolerance, double guard,
                                   double separation = 0);

}  // namespace microswarm
