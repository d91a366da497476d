// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/fmt_star.hpp"

#include <gtest/gtest.h>

#include <map>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

constexpr double kept_clearance = 15;

FmtStarParams one_set(int samples = 300) {
  FmtStarParams params;
  params.clearance = kept_clearance;
  params.goal_tolerance = 25;
  params.samples = samples;
  params.max_nodes = samples;
  return params;
}

struct Query {
  scenes::RawWorld world;
  Vec2 start;
  Vec2 goal;
};

Query random_query(int kind, std::uint32_t trial) {
  Rng rng(21, Purpose::scene, trial);
  Query q;
  q.world = kind < 0 ? scenes::RawWorld{} : scenes::random_world(kind, rng);
  q.start = scenes::random_free_point(q.world, kept_clearance, rng);
  q.goal = scenes::random_free_point(q.world, kept_clearance, rng);
  return q;
}

Plan ask(const Query& q, const FmtStarParams& params, std::uint32_t trial) {
  Rng rng(5, Purpose::planner, trial);
  return plan(q.world.snapshot(), {q.start, 0}, q.goal, params, rng);
}

/// The planner's samples drawn again from the same stream, and its radius.
struct Graph {
  std::vector<Vec2> samples;
  double radius = 0;
};

Graph drawn_again(const Query& q, const FmtStarParams& params, std::uint32_t trial) {
  Rng rng(5, Purpose::planner, trial);
  Graph graph{{q.start, q.goal}};
  const Box box = q.world.bounds.grown(-kept_clearance);
  int draws = 0;
  for (; std::ssize(graph.samples) < params.samples + 2; ++draws) {
    const Vec2 p = uniform_in(box, rng);
    if (q.world.clearance(p) >= kept_clearance) graph.samples.push_back(p);
  }
  const double free = box.width() * box.height() * (params.samples + 1.0) / (draws + 1.0);
  graph.radius = fmt_radius(params.radius_factor, free, graph.samples.size());
  return graph;
}

/// Least lengths from the start to every sample over all free edges no longer than the radius:
/// Dijkstra, every edge checked by asking every shape.
std::vector<double> dijkstra(const scenes::RawWorld& world, const Graph& graph) {
  const auto& p = graph.samples;
  std::vector<double> cost(p.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> closed(p.size(), false);
  cost[0] = 0;
  for (std::size_t round = 0; round < p.size(); ++round) {
    std::size_t z = p.size();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!closed[i] && (z == p.size() || cost[i] < cost[z])) z = i;
    closed[z] = true;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double through = cost[z] + distance(p[z], p[i]);
      if (closed[i] || distance(p[z], p[i]) > graph.radius || through >= cost[i]) continue;
      if (world.clearance(Segment{p[z], p[i]}) >= kept_clearance) cost[i] = through;
    }
  }
  return cost;
}

std::map<std::pair<double, double>, double> costs_of(const Plan& plan) {
  std::map<std::pair<double, double>, double> costs;
  for (const TreeNode& node : plan.tree) costs[{node.position.x, node.position.y}] = node.cost;
  return costs;
}

TEST(FmtStar, InTheOpenCostsAreThoseOfDijkstra) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const Query q = random_query(-1, trial);
    const FmtStarParams params = one_set();
    const Plan plan = ask(q, params, trial);
    ASSERT_EQ(plan.status, Status::solved);
    const Graph graph = drawn_again(q, params, trial);
    const std::vector<double> least = dijkstra(q.world, graph);
    const auto costs = costs_of(plan);
    std::size_t found = 0;
    for (std::size_t i = 0; i < least.size(); ++i) {
      const auto at = costs.find({graph.samples[i].x, graph.samples[i].y});
      if (at == costs.end()) continue;
      ++found;
      EXPECT_NEAR(at->second, least[i], 1e-9);
    }
    EXPECT_EQ(found, plan.tree.size());
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < least.size(); ++i)
      if (distance(graph.samples[i], q.goal) <= params.goal_tolerance)
        best = std::min(best, least[i]);
    EXPECT_NEAR(path_length(plan.path), best, 1e-9);
  }
}

TEST(FmtStar, AmongObstaclesCostsAreNeverBelowDijkstrasAndSeldomAbove) {
  std::size_t nodes = 0;
  std::size_t above = 0;
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    const Query q = random_query(static_cast<int>(trial % scenes::random_kinds), trial);
    const FmtStarParams params = one_set();
    const Plan plan = ask(q, params, trial);
    const Graph graph = drawn_again(q, params, trial);
    const std::vector<double> least = dijkstra(q.world, graph);
    const auto costs = costs_of(plan);
    std::size_t reachable = 0;
    for (std::size_t i = 0; i < least.size(); ++i) {
      reachable += least[i] < std::numeric_limits<double>::infinity();
      const auto at = costs.find({graph.samples[i].x, graph.samples[i].y});
      if (at == costs.end()) continue;
      ++nodes;
      EXPECT_GE(at->second, least[i] - 1e-9);
      above += at->second > least[i] + 1e-9;
    }
    EXPECT_LE(plan.tree.size(), reachable);
  }
  EXPECT_LT(above, nodes / 20);
}

TEST(FmtStar, ChecksNoEdgeTwiceAndFewOfAll) {
  for (std::uint32_t trial = 0; trial < 10; ++trial) {
    const Query q = random_query(static_cast<int>(trial % scenes::random_kinds), trial);
    const Plan plan = ask(q, one_set(2000), trial);
    // One free edge a node, and what was in the way: far fewer than the graph's, some 17 a node.
    EXPECT_LT(plan.counts.edge_checks, 2 * plan.tree.size() + 100);
    EXPECT_GE(plan.counts.edge_checks, plan.tree.size() - 1);
  }
}

TEST(FmtStar, PathsGetShorterWithMoreSamples) {
  double few = 0;
  double many = 0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    Query q = random_query(-1, trial);
    q.start = {50, 50};
    q.goal = {950, 650};
    few += path_length(ask(q, one_set(200), trial).path);
    many += path_length(ask(q, one_set(4000), trial).path);
  }
  EXPECT_LT(many, few);
  EXPECT_LT(many / 20, 1.04 * norm(Vec2{900, 600}));
}

TEST(FmtStar, DoublesTheSamplesUntilThereIsAWay) {
  Query q;  // two rooms and a gap in which the clearance leaves 10 µm
  q.world.walls = {scenes::rectangle({{490, 0}, {510, 330}}),
                   scenes::rectangle({{490, 370}, {510, 700}})};
  q.start = {100, 100};
  q.goal = {900, 100};
  FmtStarParams params = one_set(50);
  EXPECT_EQ(ask(q, params, 0).status, Status::node_limit);
  params.max_nodes = 50'000;
  const Plan plan = ask(q, params, 0);
  EXPECT_EQ(plan.status, Status::solved);
  EXPECT_GT(plan.tree.size(), 50u);
}

TEST(FmtStar, KeepsAtLeastTheClearance) {
  Query q;
  q.world.discs = {{{500, 350}, 150}};
  q.start = {100, 350};
  q.goal = {900, 350};
  FmtStarParams params = one_set(2000);
  const Plan plan = ask(q, params, 0);
  ASSERT_EQ(plan.status, Status::solved);
  for (const TreeNode& node : plan.tree)
    EXPECT_GE(q.world.clearance(Segment{plan.tree[node.parent].position, node.position}),
              kept_clearance - 1e-9);
}

TEST(FmtStar, RadiusIsThatOfTheTheory) {
  // γ = 2 (1 + η) (1/d)^(1/d) (μ / ζ_d)^(1/d) for d = 2
  EXPECT_NEAR(fmt_radius(1, pi, 100), 2 * std::sqrt(0.5) * std::sqrt(std::log(100.0) / 100), 1e-12);
  EXPECT_NEAR(fmt_radius(1.5, 4 * pi, 100), 3 * fmt_radius(1, pi, 100), 1e-12);
}

}  // namespace
}  // namespace microswarm::planning
