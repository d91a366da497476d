// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/straighten.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/planning/trees/rrt.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

double cost_of(std::span<const Vec2> path, double start_heading, PathCost cost) {
  return cost.per_length * path_length(path) + cost.per_turn * path_turning(path, start_heading);
}

TEST(Straighten, DetourInTheOpenBecomesTheStraightWay) {
  const Snapshot world = scenes::RawWorld{}.snapshot();
  std::vector<Vec2> path{{100, 100}, {200, 300}, {300, 100}, {400, 300}, {900, 100}};
  std::uint64_t checks = 0;
  straighten(world, 10, 0, {1, 100}, 0, path, checks);
  EXPECT_EQ(path, (std::vector<Vec2>{{100, 100}, {900, 100}}));
  EXPECT_GT(checks, 0u);
}

TEST(Straighten, LeavesShortPathsAlone) {
  const Snapshot world = scenes::RawWorld{}.snapshot();
  std::uint64_t checks = 0;
  std::vector<Vec2> point{{100, 100}};
  straighten(world, 10, 0, {1, 100}, 2, point, checks);
  EXPECT_EQ(point.size(), 1u);
}

TEST(Straighten, FindsTheCheapestChainOfVertices) {
  Rng rng(4, Purpose::test);
  for (int trial = 0; trial < 100; ++trial) {
    const scenes::RawWorld world = scenes::random_world(trial % 2, rng);
    RrtParams params;
    params.clearance = 10;
    const Vec2 start = scenes::random_free_point(world, 10, rng);
    const Vec2 goal = scenes::random_free_point(world, 10, rng);
    const Snapshot snapshot = world.snapshot();
    Rng stream(1, Purpose::planner);
    const Plan rrt = plan(snapshot, {start, 1}, goal, params, stream);
    if (rrt.path.size() < 3 || rrt.path.size() > 14) continue;
    const PathCost cost{1, rng.uniform(0, 200)};
    double best = std::numeric_limits<double>::infinity();
    const std::size_t inner = rrt.path.size() - 2;
    for (std::uint32_t kept = 0; kept < (1u << inner); ++kept) {
      std::vector<Vec2> chain{rrt.path.front()};
      for (std::size_t k = 0; k < inner; ++k) {
        if (kept >> k & 1) chain.push_back(rrt.path[k + 1]);
      }
      chain.push_back(rrt.path.back());
      if (snapshot.is_free(chain, 10)) best = std::min(best, cost_of(chain, 1, cost));
    }
    std::vector<Vec2> path = rrt.path;
    std::uint64_t checks = 0;
    straighten(snapshot, 10, 1, cost, 0, path, checks);
    EXPECT_NEAR(cost_of(path, 1, cost), best, 1e-6 * best) << "trial " << trial;
  }
}

TEST(Straighten, NeverCostsMoreAndStaysFree) {
  Rng rng(5, Purpose::test);
  for (int trial = 0; trial < 100; ++trial) {
    const scenes::RawWorld world = scenes::random_world(trial % scenes::random_kinds, rng);
    RrtParams params;
    params.clearance = 15;
    params.step = rng.uniform(5, 60);
    const Vec2 start = scenes::random_free_point(world, 15, rng);
    const Vec2 goal = scenes::random_free_point(world, 15, rng);
    const Snapshot snapshot = world.snapshot();
    Rng stream(1, Purpose::planner);
    const std::vector<Vec2> before = plan(snapshot, {start, 2}, goal, params, stream).path;
    for (const int rounds : {0, 1, 3}) {
      std::vector<Vec2> path = before;
      std::uint64_t checks = 0;
      straighten(snapshot, 15, 2, {1, 100}, rounds, path, checks);
      EXPECT_EQ(path.front(), before.front());
      EXPECT_EQ(path.back(), before.back());
      const double old = cost_of(before, 2, {1, 100});
      EXPECT_LE(cost_of(path, 2, {1, 100}), old * (1 + 1e-9) + 1e-9);
      for (std::size_t i = 1; i < path.size(); ++i) {
        ASSERT_GE(world.clearance(Segment{path[i - 1], path[i]}), 15 - 1e-9) << "trial " << trial;
      }
    }
  }
}

}  // namespace
}  // namespace microswarm::planning
