// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"
#include "microswarm/core/maths/infinity.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "microswarm/core/maths/hash.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

/// As in the paper: Alg 1 alone grows the tree.
ObstacleWeightedRrtParams with_nodes(int nodes) {
  ObstacleWeightedRrtParams params;
  params.nodes = nodes;
  params.complete = false;
  return params;
}

ObstacleWeightedRrt grow(const Map& map, Vec2 goal, const ObstacleWeightedRrtParams& params,
                         std::uint64_t seed = 1) {
  Rng rng(seed, Purpose::planner);
  return obstacle_weighted_rrt(map, goal, params, rng);
}

bool sees(const Map& map, Vec2 a, Vec2 b) { return map.is_free(Segment{a, b}, 0); }

std::string hash_of(const ObstacleWeightedRrt& tree) {
  Hash hash;
  for (const Vec2 p : tree.nodes) hash.value(p.x), hash.value(p.y);
  for (const double w : tree.weights) hash.value(w);
  for (const Routes* routes : {&tree.plain, &tree.weighted}) {
    for (const std::uint32_t next : routes->next) hash.value(next);
    for (const double cost : routes->cost) hash.value(cost);
  }
  return hash.hex();
}

/// Two halls of 20 × 20 and a passage of 20 × `width` between them.
Map two_halls(double width) {
  return Map({{0, 0}, {60, 20}}, {scenes::rectangle({{20, -1}, {40, 10 - width / 2}}),
                                  scenes::rectangle({{20, 10 + width / 2}, {40, 21}})});
}

/// Maps of all kinds, small trees.
struct Case {
  scenes::Vascular scene;
  ObstacleWeightedRrtParams params;
};
std::vector<Case> cases() {
  std::vector<Case> all{{scenes::t_junction(), with_nodes(1500)},
                        {scenes::vascular_network(), with_nodes(2500)}};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    scenes::VascularShape shape;
    shape.min_half = seed % 2 == 0 ? 1.5 : 3.5;  // also channels that ζ shuts
    Rng rng(seed, Purpose::scene);
    all.push_back({scenes::random_vascular(shape, rng), with_nodes(2500)});
  }
  return all;
}

void expect_routes_lead_to_goal(const Map& map, const ObstacleWeightedRrt& tree,
                                const Routes& routes, bool weighted) {
  ASSERT_EQ(routes.next.size(), tree.nodes.size());
  ASSERT_EQ(routes.cost.size(), tree.nodes.size());
  ASSERT_EQ(routes.length.size(), tree.nodes.size());
  EXPECT_EQ(routes.next[0], 0u);
  EXPECT_EQ(routes.cost[0], 0);
  for (std::uint32_t v = 1; v < tree.nodes.size(); ++v) {
    const std::uint32_t next = routes.next[v];
    const double step = distance(tree.nodes[v], tree.nodes[next]);
    ASSERT_TRUE(sees(map, tree.nodes[v], tree.nodes[next]));
    ASSERT_NEAR(routes.length[v], step + routes.length[next], 1e-9);
    ASSERT_NEAR(routes.cost[v], step + (weighted ? tree.weights[next] : 0) + routes.cost[next],
                1e-9 * (1 + routes.cost[v]));
    ASSERT_LT(routes.cost[next], routes.cost[v]);  // hence every way ends at the goal
  }
}

TEST(ObstacleWeightedRrt, EveryNodesWayToTheGoalIsFree) {
  for (const Case& c : cases()) {
    const Map map = c.scene.map();
    const ObstacleWeightedRrt tree = grow(map, c.scene.goal, c.params);
    EXPECT_EQ(tree.status, Status::solved);
    EXPECT_EQ(tree.nodes.size(), static_cast<std::size_t>(c.params.nodes));
    EXPECT_EQ(tree.nodes[0], c.scene.goal);
    expect_routes_lead_to_goal(map, tree, tree.plain, false);
    expect_routes_lead_to_goal(map, tree, tree.weighted, true);
  }
}

TEST(ObstacleWeightedRrt, BoundaryPointsLieOnWalls) {
  for (const Case& c : cases()) {
    const Map map = c.scene.map();
    const ObstacleWeightedRrt tree = grow(map, c.scene.goal, c.params);
    ASSERT_FALSE(tree.boundary.empty());
    for (const Vec2 p : tree.boundary) ASSERT_LT(map.clearance(p), 1e-5);
  }
}

TEST(ObstacleWeightedRrt, WeightsAreThoseOfEquation3) {
  const ObstacleWeightedRrtParams params = with_nodes(600);
  const ObstacleWeightedRrt tree = grow(scenes::t_junction().map(), {50, 53}, params);
  EXPECT_EQ(tree.weights[0], 0);
  for (std::uint32_t v = 1; v < tree.nodes.size(); ++v) {
    double d = infinity;
    for (const Vec2 p : tree.boundary) d = std::min(d, distance(tree.nodes[v], p));
    ASSERT_EQ(tree.clearances[v], d);
    ASSERT_NEAR(tree.weights[v], d < 4 ? std::exp(6 - d) - std::exp(2.0) : 0, 1e-9);
    if (tree.weights[v] < params.zeta) {
      ASSERT_EQ(tree.medial[v], 1);
    }
  }
}

/// Bellman–Ford over all pairs: what Alg 2, lines 7–12 print.
std::vector<double> brute_costs(const Map& map, const ObstacleWeightedRrt& tree, double radius) {
  std::vector<double> cost(tree.nodes.size(), infinity);
  cost[0] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t v = 0; v < cost.size(); ++v) {
      for (std::uint32_t u = 0; u < cost.size(); ++u) {
        if (u == v || !tree.medial[u] || !tree.medial[v] || cost[u] == infinity) continue;
        const double step = distance(tree.nodes[u], tree.nodes[v]);
        const double via = step + tree.weights[u] + cost[u];
        if (step > radius || via >= cost[v] || !sees(map, tree.nodes[u], tree.nodes[v])) continue;
        cost[v] = via;
        changed = true;
      }
    }
  }
  return cost;
}

TEST(ObstacleWeightedRrt, CostsOfTheMiddleAreTheLeast) {
  for (const double radius : {1.3, 2.4, 6.0}) {
    ObstacleWeightedRrtParams params = with_nodes(500);
    params.neighbour_radius = radius;
    const Map map = two_halls(9);
    const ObstacleWeightedRrt tree = grow(map, {3, 10}, params);
    const std::vector<double> brute = brute_costs(map, tree, radius);
    for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
      if (tree.medial[v]) {
        ASSERT_NEAR(tree.weighted.cost[v], brute[v], 1e-9);
      }
    }
  }
}

TEST(ObstacleWeightedRrt, OtherNodesGoToTheNearestOfTheMiddleThatTheySee) {
  const Map map = scenes::t_junction().map();
  const ObstacleWeightedRrt tree = grow(map, {50, 53}, with_nodes(2000));
  for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
    if (tree.medial[v]) continue;
    double least = infinity;
    for (std::uint32_t u = 0; u < tree.nodes.size(); ++u) {
      const double d = distance(tree.nodes[u], tree.nodes[v]);
      if (tree.medial[u] && d < least && sees(map, tree.nodes[u], tree.nodes[v])) least = d;
    }
    ASSERT_EQ(distance(tree.nodes[v], tree.nodes[tree.weighted.next[v]]), least);
  }
}

/// Is V* with this ζ one piece, as far as it must be: do all nodes lighter than `wanted` join?
bool joins(const Map& map, const ObstacleWeightedRrt& tree, double zeta, double wanted,
           double radius) {
  std::vector<std::uint8_t> reached(tree.nodes.size(), 0);
  std::vector<std::uint32_t> waiting{0};
  reached[0] = 1;
  while (!waiting.empty()) {
    const std::uint32_t u = waiting.back();
    waiting.pop_back();
    for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
      if (reached[v] || tree.weights[v] >= zeta) continue;
      if (distance(tree.nodes[u], tree.nodes[v]) > radius) continue;
      if (!sees(map, tree.nodes[u], tree.nodes[v])) continue;
      reached[v] = 1;
      waiting.push_back(v);
    }
  }
  for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
    if (tree.weights[v] < wanted && !reached[v]) return false;
  }
  return true;
}

TEST(ObstacleWeightedRrt, ZetaIsRaisedJustEnoughToJoinThePieces) {
  ObstacleWeightedRrtParams params = with_nodes(1500);
  params.narrow_share = 0;  // as printed
  const ObstacleWeightedRrt wide = grow(two_halls(10), {10, 10}, params);
  EXPECT_EQ(wide.zeta_used, params.zeta);

  const Map map = two_halls(4);  // 2 from either wall at most
  const ObstacleWeightedRrt tree = grow(map, {10, 10}, params);
  EXPECT_GT(tree.zeta_used, std::exp(4) - std::exp(2));
  EXPECT_LT(tree.zeta_used, std::exp(5) - std::exp(2));
  EXPECT_TRUE(joins(map, tree, tree.zeta_used, params.zeta, params.neighbour_radius));
  EXPECT_FALSE(
      joins(map, tree, std::nextafter(tree.zeta_used, 0), params.zeta, params.neighbour_radius));
  for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
    if (tree.medial[v] && v != 0) {
      EXPECT_TRUE(tree.medial[tree.weighted.next[v]]);
    }
  }
}

TEST(ObstacleWeightedRrt, WaysKeepToTheMiddle) {
  const Map map = scenes::t_junction().map();
  const ObstacleWeightedRrt tree = grow(map, {50, 53}, with_nodes(4000));
  double plain = 0;
  double weighted = 0;
  for (std::uint32_t v = 0; v < tree.nodes.size(); ++v) {
    plain += map.clearance(tree.nodes[tree.plain.next[v]]);
    weighted += map.clearance(tree.nodes[tree.weighted.next[v]]);
  }
  EXPECT_GT(weighted, 1.4 * plain);
}

TEST(ObstacleWeightedRrt, TheSameSeedGivesTheSameBits) {
  const scenes::Vascular scene = scenes::vascular_network();
  const Map map = scene.map();
  const ObstacleWeightedRrtParams params = with_nodes(2000);
  EXPECT_EQ(hash_of(grow(map, scene.goal, params, 3)), hash_of(grow(map, scene.goal, params, 3)));
  EXPECT_NE(hash_of(grow(map, scene.goal, params, 3)), hash_of(grow(map, scene.goal, params, 4)));
}

TEST(ObstacleWeightedRrt, ScaledParametersGrowTheSameTreeInAScaledMap) {
  const ObstacleWeightedRrtParams params = with_nodes(1000);
  scenes::Vascular scene = scenes::t_junction();
  const ObstacleWeightedRrt small = grow(scene.map(), scene.goal, params);
  for (Polygon& wall : scene.walls) {
    for (Vec2& p : wall.outer) p = 8.0 * p;
  }
  const Map map({8.0 * scene.bounds.lo, 8.0 * scene.bounds.hi}, scene.walls);
  const ObstacleWeightedRrt large = grow(map, 8.0 * scene.goal, scaled(params, 8));
  ASSERT_EQ(small.nodes.size(), large.nodes.size());
  for (std::uint32_t v = 0; v < small.nodes.size(); ++v) {
    ASSERT_NEAR(distance(8.0 * small.nodes[v], large.nodes[v]), 0, 1e-6);
    ASSERT_EQ(small.medial[v], large.medial[v]);
    ASSERT_NEAR(8 * small.weighted.cost[v], large.weighted.cost[v], 1e-6);
  }
}

TEST(ObstacleWeightedRrt, LooksUpTheNearestNodeThatIsSeen) {
  for (const Case& c : cases()) {
    const Map map = c.scene.map();
    const ObstacleWeightedRrt tree = grow(map, c.scene.goal, c.params);
    Rng rng(7, Purpose::test);
    int seen = 0;
    int asked = 0;
    while (asked < 400) {
      const Vec2 p = uniform_in(map.bounds(), rng);
      if (!map.is_free(p, 0)) continue;
      ++asked;
      double nearest = infinity;
      double visible = infinity;
      for (const Vec2 node : tree.nodes) {
        nearest = std::min(nearest, distance(p, node));
        if (distance(p, node) < visible && sees(map, p, node)) visible = distance(p, node);
      }
      const Vec2 found = tree.nodes[tree.nearest(p)];
      ASSERT_GE(distance(p, found), nearest);
      ASSERT_LE(distance(p, found), visible);
      seen += sees(map, p, found);
      const auto best = tree.nearest_visible(map, p);
      ASSERT_TRUE(best.has_value());
      ASSERT_EQ(distance(p, tree.nodes[*best]), visible);
      EXPECT_EQ(tree.cost(tree.weighted, p),
                distance(p, found) + tree.weighted.cost[tree.nearest(p)]);
    }
    EXPECT_GT(seen, 0.98 * asked);
  }
}

TEST(ObstacleWeightedRrt, NobodyIsSentThroughAThinWall) {
  const Map map({{0, 0}, {40, 20}}, {scenes::rectangle({{0, 9.95}, {35, 10.05}})});
  const ObstacleWeightedRrt tree = grow(map, {3, 5}, with_nodes(3000));
  for (double x = 1; x < 33; x += 0.05) {
    for (const double y : {9.9, 9.7, 10.1, 10.3}) {
      ASSERT_TRUE(sees(map, {x, y}, tree.nodes[tree.nearest({x, y})]));
    }
  }
}

TEST(ObstacleWeightedRrt, SaysWhyItEnded) {
  const scenes::Vascular scene = scenes::t_junction();
  const Map map = scene.map();
  EXPECT_EQ(grow(map, {20, 60}, with_nodes(10)).status, Status::goal_blocked);
  EXPECT_TRUE(grow(map, {20, 60}, with_nodes(10)).nodes.empty());
  EXPECT_EQ(grow(map, {infinity, 0}, with_nodes(10)).status, Status::goal_blocked);

  ObstacleWeightedRrtParams few = with_nodes(4000);
  few.max_iterations = 300;
  const ObstacleWeightedRrt cut = grow(map, scene.goal, few);
  EXPECT_EQ(cut.status, Status::node_limit);
  EXPECT_LT(cut.nodes.size(), 301u);
  expect_routes_lead_to_goal(map, cut, cut.weighted, true);

  const std::atomic<bool> flag{true};
  Rng rng(1, Purpose::planner);
  const Stop stop(&flag);
  const ObstacleWeightedRrt stopped =
      obstacle_weighted_rrt(map, scene.goal, with_nodes(4000), rng, stop);
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_EQ(stopped.nearest({50, 80}), 0u);
  expect_routes_lead_to_goal(map, stopped, stopped.weighted, false);
}

// A tree far too small for its map; what is reached is told by a grid finer than the cover's.
TEST(ObstacleWeightedRrt, ACompletedTreeIsSeenFromEverywhere) {
  for (const Case& c : cases()) {
    const Map map = c.scene.map();
    ObstacleWeightedRrtParams params = with_nodes(60);
    params.complete = true;
    const ObstacleWeightedRrt tree = grow(map, c.scene.goal, params);
    EXPECT_EQ(tree.grown, 60u);
    EXPECT_GT(tree.nodes.size(), 60u);
    expect_routes_lead_to_goal(map, tree, tree.plain, false);
    expect_routes_lead_to_goal(map, tree, tree.weighted, true);
    const Box& box = map.bounds();
    Rng rng(3, Purpose::test);
    int unseen = 0;
    int all = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec2 p = uniform_in(box, rng);
      if (!map.is_free(p, 0.3)) continue;
      ++all;
      unseen += !tree.nearest_visible(map, p);
    }
    EXPECT_LE(unseen, all / 1000) << "of " << all;
  }
}

TEST(ObstacleWeightedRrt, OneNodeAndAGoalThatIsAlone) {
  const ObstacleWeightedRrt tree = grow(scenes::t_junction().map(), {50, 53}, with_nodes(1));
  EXPECT_EQ(tree.status, Status::solved);
  EXPECT_EQ(tree.nearest({0.5, 99}), 0u);
  EXPECT_EQ(tree.medial[0], 1);
}

}  // namespace
}  // namespace microswarm::planning
