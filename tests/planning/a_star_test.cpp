// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/grid/a_star.hpp"
#include "microswarm/planning/exact/exact.hpp"
#include "microswarm/planning/grid/theta_star.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <queue>
#include <set>

#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

Plan ask(const Snapshot& world, Vec2 start, Vec2 goal, const AStarParams& params) {
  Rng rng(1, Purpose::planner);
  return plan(world, {start, 0}, goal, params, rng);
}

AStarParams on_cells() {
  AStarParams params;
  params.clearance = 0;
  params.goal_tolerance = 0.1;
  params.cell = 1;
  return params;
}

scenes::RawWorld ten_by_ten() {
  scenes::RawWorld world;
  world.bounds = {{0, 0}, {10, 10}};
  return world;
}

TEST(AStar, OctileDistanceInTheOpen) {
  const Plan found = ask(ten_by_ten().snapshot(), {0.5, 0.5}, {8.5, 3.5}, on_cells());
  EXPECT_EQ(found.status, Status::solved);
  EXPECT_NEAR(path_length(found.path), 5 + 3 * std::numbers::sqrt2, 1e-12);
}

TEST(AStar, CutsNoCorner) {
  scenes::RawWorld world = ten_by_ten();
  world.walls = {scenes::rectangle({{4, 4}, {5, 5}})};
  const Plan found = ask(world.snapshot(), {3.5, 4.5}, {4.5, 5.5}, on_cells());
  EXPECT_EQ(found.status, Status::solved);
  EXPECT_NEAR(path_length(found.path), 2, 1e-12);
}

TEST(AStar, SeesAWallThinnerThanACell) {
  scenes::RawWorld world = ten_by_ten();
  world.walls = {scenes::rectangle({{4.999, 0}, {5.001, 9}})};
  const Plan found = ask(world.snapshot(), {4.5, 0.5}, {5.5, 0.5}, on_cells());
  EXPECT_EQ(found.status, Status::solved);
  EXPECT_NEAR(path_length(found.path), 9 + 1 + 9, 1e-12);
  world.walls = {scenes::rectangle({{4.999, 0}, {5.001, 10}})};
  EXPECT_EQ(ask(world.snapshot(), {4.5, 0.5}, {5.5, 0.5}, on_cells()).status, Status::no_path);
}

TEST(AStar, OpensNoMoreCellsThanAllowed) {
  AStarParams params = on_cells();
  params.max_nodes = 5;
  const Plan found = ask(ten_by_ten().snapshot(), {0.5, 0.5}, {8.5, 8.5}, params);
  EXPECT_EQ(found.status, Status::node_limit);
  EXPECT_EQ(found.counts.iterations, 5u);
  EXPECT_GT(found.path.size(), 1u);
  params = on_cells();
  params.cell = 1e-9;
  EXPECT_EQ(ask(ten_by_ten().snapshot(), {0.5, 0.5}, {8.5, 8.5}, params).status,
            Status::node_limit);
}

/// A wall of two halves with a gap.
scenes::RawWorld gate(double gap) {
  scenes::RawWorld world = ten_by_ten();
  world.walls = {scenes::rectangle({{4.5, 0}, {5.5, 4.3}}),
                 scenes::rectangle({{4.5, 4.3 + gap}, {5.5, 10}})};
  return world;
}

template <class Params>
Params in_gate(double tolerance, double cell) {
  Params params;
  params.clearance = 0.1;
  params.goal_tolerance = tolerance;
  params.cell = cell;
  return params;
}

template <class Params>
class GridPlanners : public testing::Test {
 protected:
  /// From one side of the gate to the other.
  static Plan through(const Snapshot& world, const Params& params) {
    Rng rng(1, Purpose::planner);
    return plan(world, {{1.05, 1.05}, 0}, {9.05, 1.05}, params, rng);
  }
};
using GridKinds = testing::Types<AStarParams, ThetaStarParams>;
TYPED_TEST_SUITE(GridPlanners, GridKinds);

TYPED_TEST(GridPlanners, AFinerGridFindsAGapBetweenItsPoints) {
  auto params = in_gate<TypeParam>(0.5, 1);
  const Snapshot narrow = gate(0.3).snapshot();
  const Plan found = this->through(narrow, params);
  ASSERT_EQ(found.status, Status::solved);
  for (std::size_t i = 0; i + 1 < found.path.size(); ++i)
    EXPECT_GE(narrow.map().clearance(Segment{found.path[i], found.path[i + 1]}, 1), 0.1 - 1e-9);
  params.max_nodes = 100;
  EXPECT_EQ(this->through(narrow, params).status, Status::node_limit);
}

TYPED_TEST(GridPlanners, AnOriginSetsThePhaseAndStartAndGoalAreJoinedToIt) {
  auto params = in_gate<TypeParam>(0.01, 0.5);
  params.origin = Vec2{-30, 4.45};  // the gap leaves 4.4 to 4.5
  params.max_nodes = 400;           // places of this grid, which is not halved
  const Snapshot narrow = gate(0.3).snapshot();
  const Plan found = this->through(narrow, params);
  ASSERT_EQ(found.status, Status::solved);
  EXPECT_EQ(found.path.front(), (Vec2{1.05, 1.05}));
  EXPECT_LE(distance(found.path.back(), Vec2{9.05, 1.05}), 0.01);
  for (std::size_t i = 0; i + 1 < found.path.size(); ++i)
    EXPECT_GE(narrow.map().clearance(Segment{found.path[i], found.path[i + 1]}, 1), 0.1 - 1e-9);
  params.origin = Vec2{-30, 4.2};  // no row in the gap
  EXPECT_EQ(this->through(narrow, params).status, Status::node_limit);
}

TYPED_TEST(GridPlanners, NoPathIsSaidOnlyOfAGapThatIsTooNarrow) {
  const Snapshot narrower = gate(0.19).snapshot();
  EXPECT_EQ(this->through(narrower, in_gate<TypeParam>(0.5, 1)).status, Status::no_path);
}

TEST(ThetaStar, IsStraightInTheOpenAndTautAroundACorner) {
  const auto params = in_gate<ThetaStarParams>(0.05, 0.25);
  Rng rng(1, Purpose::planner);
  const Plan open = plan(ten_by_ten().snapshot(), {{1, 1}, 0}, {9, 4}, params, rng);
  ASSERT_EQ(open.status, Status::solved);
  EXPECT_EQ(open.path.size(), 2u);
  scenes::RawWorld world = ten_by_ten();
  world.walls = {scenes::rectangle({{4, 0}, {5, 6}})};
  const Snapshot wall = world.snapshot();
  const Plan around = plan(wall, {{1, 1}, 0}, {9, 1}, params, rng);
  const Plan best =
      plan(wall, {{1, 1}, 0}, {9, 1}, ExactParams{.clearance = 0.1, .goal_tolerance = 0.05}, rng);
  ASSERT_EQ(around.status, Status::solved);
  EXPECT_GE(path_length(around), path_length(best) - 0.05);
  EXPECT_LE(path_length(around), 1.02 * path_length(best));
}

/// Least length to any grid point within the tolerance by Dijkstra over std containers.
double dijkstra(const scenes::RawWorld& world, Vec2 start, Vec2 goal, const AStarParams& params) {
  using Place = std::pair<int, int>;
  const auto at = [&](Place p) {
    return start + params.cell * Vec2{1.0 * p.first, 1.0 * p.second};
  };
  const auto open = [&](Place p) { return world.clearance(at(p)) >= params.clearance; };
  std::set<Place> closed;
  std::priority_queue<std::pair<double, Place>, std::vector<std::pair<double, Place>>,
                      std::greater<>>
      queue;
  queue.push({0, {0, 0}});
  while (!queue.empty()) {
    const auto [cost, p] = queue.top();
    queue.pop();
    if (!closed.insert(p).second) continue;
    if (distance(at(p), goal) <= params.goal_tolerance) return cost;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Place q{p.first + dx, p.second + dy};
        if (q == p || !open(q) || !open({p.first + dx, p.second}) ||
            !open({p.first, p.second + dy}) ||
            world.clearance(Segment{at(p), at(q)}) < params.clearance) {
          continue;
        }
        queue.push({cost + params.cell * std::hypot(dx, dy), q});
      }
    }
  }
  return -1;
}

TEST(AStar, IsOptimalOnItsGrid) {
  int solved = 0;
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    Rng rng(5, Purpose::scene, trial);
    const scenes::RawWorld world = scenes::random_world(trial % scenes::random_kinds, rng);
    AStarParams params;
    params.clearance = rng.uniform(0, 30);
    params.goal_tolerance = rng.uniform(20, 80);
    params.cell = rng.uniform(25, 50);
    const Vec2 start = scenes::random_free_point(world, params.clearance, rng);
    const Vec2 goal = scenes::random_free_point(world, params.clearance, rng);
    const Plan found = ask(world.snapshot(), start, goal, params);
    const double best = dijkstra(world, start, goal, params);
    if (best < 0) continue;  // a finer grid may have a path
    ASSERT_EQ(found.status, Status::solved) << trial;
    ++solved;
    EXPECT_NEAR(path_length(found.path), best, 1e-9 * (1 + best)) << trial;
  }
  EXPECT_GT(solved, 30);
}

}  // namespace
}  // namespace microswarm::planning
