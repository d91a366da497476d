// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/search_tree.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm::planning {
namespace {

const Box bounds{{0, 0}, {100, 100}};

Vec2 random_point(Rng& rng) {
  const double x = rng.uniform(0, 100);
  return {x, rng.uniform(0, 100)};
}

bool hangs_below(const SearchTree& tree, std::uint32_t node, std::uint32_t above) {
  while (node != 0 && node != above) node = tree[node].parent;
  return node == above;
}

void expect_costs_right(const SearchTree& tree, PathCost cost) {
  for (std::uint32_t i = 1; i < tree.size(); ++i) {
    const TreeNode& parent = tree[tree[i].parent];
    ASSERT_EQ(tree[i].heading, heading_along(tree[i].position - parent.position));
    ASSERT_EQ(tree[i].cost, parent.cost + cost.edge(parent, tree[i].position));
  }
}

TEST(SearchTree, CountsTurningFromTheRootsHeading) {
  SearchTree tree(bounds, {{0, 0}, pi / 2}, {2, 10});
  const auto a = tree.add(0, {10, 0});
  const auto b = tree.add(a, {20, 10});
  EXPECT_DOUBLE_EQ(tree[a].cost, 2 * 10 + 10 * pi / 2);
  EXPECT_DOUBLE_EQ(tree[b].cost, tree[a].cost + 2 * std::sqrt(200.0) + 10 * pi / 4);
}

TEST(SearchTree, ReparentingTurnsTheNodeAndReCostsItsChildren) {
  SearchTree tree(bounds, {{0, 0}, 0}, {1, 10});
  const auto a = tree.add(0, {10, 0});
  const auto b = tree.add(0, {0, 10});
  const auto c = tree.add(b, {10, 10});  // heading 0
  const auto d = tree.add(c, {20, 10});  // heading 0: no turn
  tree.reparent(c, a);                   // heading π/2: a quarter turn into d
  EXPECT_DOUBLE_EQ(tree[c].cost, 20 + 10 * pi / 2);
  EXPECT_DOUBLE_EQ(tree[d].cost, 30 + 10 * pi);
}

TEST(SearchTree, CostsStayRightUnderRandomReparenting) {
  for (const PathCost cost : {PathCost{1, 0}, PathCost{1, 50}, PathCost{0, 3}}) {
    Rng rng(1, Purpose::test);
    SearchTree tree(bounds, {random_point(rng), 1}, cost);
    for (int i = 0; i < 2000; ++i) {
      if (rng.below(2) == 0) {
        tree.add(static_cast<std::uint32_t>(rng.below(tree.size())), random_point(rng));
        continue;
      }
      const auto node = static_cast<std::uint32_t>(rng.below(tree.size()));
      const auto parent = static_cast<std::uint32_t>(rng.below(tree.size()));
      if (node != 0 && !hangs_below(tree, parent, node)) tree.reparent(node, parent);
      if (i % 50 == 0) expect_costs_right(tree, cost);
    }
    expect_costs_right(tree, cost);
  }
}

TEST(SearchTree, TheLengthExcludesNoCheaperEdge) {
  for (const PathCost cost :
       {PathCost{1, 0}, PathCost{1, 50}, PathCost{0.3, 3}, PathCost{1, 50, 20}}) {
    Rng rng(3, Purpose::test);
    SearchTree tree(bounds, {random_point(rng), 1}, cost);
    int excluded = 0;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      const auto node = static_cast<std::uint32_t>(rng.below(tree.size()));
      // Straight ahead a turn costs nothing.
      const Vec2 p =
          i % 2 == 0 ? random_point(rng)
                     : tree[node].position + rng.uniform(1, 30) * unit_vector(tree[node].heading);
      const double via = tree.cost_via(node, p);
      EXPECT_TRUE(tree.may_be_cheaper(node, p, std::nextafter(via, 1e9)));
      excluded += !tree.may_be_cheaper(node, p, 0.9 * via);
      if (i % 5 == 0) tree.add(node, p);
    }
    EXPECT_EQ(excluded > 0, cost.turn_radius == 0);
  }
}

TEST(SearchTree, NearestAndNearAgreeWithBruteForce) {
  Rng rng(2, Purpose::test);
  SearchTree tree(bounds, {random_point(rng), 0}, {});
  for (int i = 0; i < 500; ++i) tree.add(0, random_point(rng));
  std::vector<std::uint32_t> found;
  for (int i = 0; i < 200; ++i) {
    const Vec2 p = random_point(rng);
    std::vector<std::uint32_t> within;
    std::uint32_t best = 0;
    for (std::uint32_t k = 0; k < tree.size(); ++k) {
      if (distance(tree[k].position, p) <= 15) within.push_back(k);
      if (distance(tree[k].position, p) < distance(tree[best].position, p)) best = k;
    }
    tree.near(p, 15, found);
    EXPECT_EQ(found, within);
    EXPECT_EQ(tree.nearest(p), best);
  }
}

}  // namespace
}  // namespace microswarm::planning
