// SPDX-License-Identifier: Apache-2.0
// What holds of gathering must hold of any tree: each law is tried on many small ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cases.hpp"
#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

constexpr Aggregation methods[] = {Aggregation::heuristic, Aggregation::divide_and_conquer,
                                   Aggregation::rollout, Aggregation::dynamic_shortest_path};

/// A tree of a sixteenth of the nodes, with edges four times as long.
AggregationParams coarse(const scenes::Vascular& scene, bool weighted) {
  AggregationParams params;
  params.obstacle_weighted = weighted;
  params.tree.nodes = scene.nodes / 16;
  params.tree.extension *= 4;
  params.tree.neighbour_radius *= 4;
  params.rollout.budget = 1e4;
  params.rollout.first_budget = 1e4;
  params.rollout.max_work = 1e3;
  params.rollout.candidates = 0;
  return params;
}

int steps(const Gathering& g, Aggregation method, int count, std::uint32_t trial, int most) {
  AggregationParams params = g.params;
  params.method = method;
  Robots robots = g.robots(count, trial);
  GatherResult result;
  if (method == Aggregation::rollout) {
    RolloutPolicy policy(g.ground, g.stepper, params, Rng(1, Purpose::planner));
    result = gather(g.stepper, policy, robots, most);
  } else {
    AggregationPolicy policy(g.ground, params);
    result = gather(g.stepper, policy, robots, most);
  }
  return result.status == Status::solved ? result.steps : most;
}

/// On many trees all gather with every method, and none takes `factor` times the median.
void expect_no_tree_is_special(const scenes::Vascular& scene, int trees, int count, double factor) {
  constexpr int most = 50'000;
  for (const bool weighted : {true, false}) {
    std::vector<std::vector<int>> all(std::size(methods));
    for (int tree = 1; tree <= trees; ++tree) {
      const Gathering g(scene, coarse(scene, weighted), static_cast<std::uint64_t>(tree));
      for (std::size_t m = 0; m < all.size(); ++m)
        all[m].push_back(steps(g, methods[m], count, static_cast<std::uint32_t>(tree), most));
    }
    for (std::size_t m = 0; m < all.size(); ++m) {
      std::sort(all[m].begin(), all[m].end());
      const int median = all[m][all[m].size() / 2];
      EXPECT_LT(all[m].back(), most) << scene.name << m << weighted;
      EXPECT_LT(all[m].back(), factor * median) << scene.name << m << weighted;
    }
  }
}

TEST(AggregationTrees, TJunction) {
  expect_no_tree_is_special(scenes::t_junction(), test::cases(100), 4, 8);
}

TEST(AggregationTrees, VascularNetwork) {
  expect_no_tree_is_special(scenes::vascular_network(), test::cases(100), 4, 8);
}

TEST(AggregationTrees, LargerVascularNetwork) {
  expect_no_tree_is_special(scenes::larger_vascular_network(), test::cases(12), 4, 8);
}

}  // namespace
}  // namespace microswarm::navigation
