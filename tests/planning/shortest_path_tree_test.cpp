// SPDX-License-Identifier: Apache-2.0
// Paths to one goal out of a tree beside those that are searched one by one.
#include "microswarm/planning/exact/shortest_path_tree.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "random_worlds.hpp"

namespace microswarm::planning {
namespace {

TEST(ShortestPathTree, PathsAreAsLongAsThoseSearchedOneByOne) {
  Rng rng(11, Purpose::test);
  int bent = 0, without = 0, blocked = 0;
  for (int number = 0; number < 80; ++number) {
    SCOPED_TRACE(number);
    const Map map = number % 2 == 0 ? crowded_map(rng) : random_map(rng);
    const double clearance = number % 3 == 0 ? 0 : rng.uniform(0.5, 5);
    const Vec2 goal = uniform_in(map.bounds(), rng);
    ShortestPathTree tree(map, goal, clearance);
    ShortestPaths paths(map, clearance);
    for (int query = 0; query < 20; ++query) {
      const Vec2 start = uniform_in(map.bounds(), rng);
      const double length = tree.length_from(start);
      const std::vector<Vec2> path = tree.path_from(start);
      ASSERT_EQ(path.empty(), length == infinity);
      if (!map.is_free(start, clearance) || !map.is_free(goal, clearance)) {
        ++blocked;
        EXPECT_EQ(length, infinity);
        continue;
      }
      const ShortestPath other = paths.find(start, goal);
      if (other.status != Status::solved) {
        ++without;
        EXPECT_EQ(length, infinity);
        continue;
      }
      EXPECT_NEAR(length, other.length, 1e-9 * other.length);
      bent += path.size() > 2;
      EXPECT_EQ(path.front(), start);
      EXPECT_EQ(path.back(), goal);
      EXPECT_GE(path_length(path), length - 1e-6);
      EXPECT_LE(path_length(path), 1.001 * length + 1e-6);
      for (std::size_t i = 1; i < path.size(); ++i)
        EXPECT_TRUE(map.is_free(Segment{path[i - 1], path[i]}, clearance)) << i;
    }
  }
  EXPECT_GT(bent, 250);
  EXPECT_GT(without, 2);
  EXPECT_GT(blocked, 25);
}

TEST(ShortestPathTree, WhatWasAskedBeforeChangesNoBit) {
  Rng rng(12, Purpose::test);
  for (int number = 0; number < 20; ++number) {
    const Map map = crowded_map(rng);
    const double clearance = rng.uniform(0, 3);
    const Vec2 goal = uniform_in(map.bounds(), rng);
    ShortestPathTree tree(map, goal, clearance);
    for (int query = 0; query < 30; ++query) {
      const Vec2 start = uniform_in(map.bounds(), rng);
      EXPECT_EQ(tree.path_from(start), ShortestPathTree(map, goal, clearance).path_from(start));
    }
  }
}

TEST(ShortestPathTree, OneThatBeginsAnewAnswersTheSame) {
  Rng rng(13, Purpose::test);
  int bent = 0;
  for (int number = 0; number < 20; ++number) {
    const Map map = crowded_map(rng);
    const double clearance = rng.uniform(0, 3);
    const Vec2 goal = uniform_in(map.bounds(), rng);
    ShortestPathTree tree(map, goal, clearance), small(map, goal, clearance);
    small.limit_bytes(0);
    for (int query = 0; query < 30; ++query) {
      const Vec2 start = uniform_in(map.bounds(), rng);
      const std::vector<Vec2> path = tree.path_from(start);
      EXPECT_EQ(small.path_from(start), path);
      bent += path.size() > 2;
    }
  }
  EXPECT_GT(bent, 100);
}

TEST(ShortestPathTree, AsItGrowsEvenlyThePathsAreTheSame) {
  Rng rng(14, Purpose::test);
  for (int number = 0; number < 20; ++number) {
    const Map map = number % 2 == 0 ? crowded_map(rng) : random_map(rng);
    const double clearance = number % 3 == 0 ? 0 : rng.uniform(0, 3);
    const Vec2 goal = uniform_in(map.bounds(), rng);
    ShortestPathTree tree(map, goal, clearance);
    ShortestPathTree even(map, goal, clearance, ShortestPathTree::Growth::evenly);
    for (int query = 0; query < 30; ++query) {
      const Vec2 start = uniform_in(map.bounds(), rng);
      EXPECT_EQ(even.path_from(start), tree.path_from(start));
    }
  }
}

TEST(ShortestPathTree, OneThatIsStoppedGoesOnWithTheNextQuery) {
  Rng rng(15, Purpose::test);
  int stopped = 0;
  for (int number = 0; number < 20; ++number) {
    const Map map = crowded_map(rng);
    const Vec2 goal = uniform_in(map.bounds(), rng);
    ShortestPathTree tree(map, goal, 1), whole(map, goal, 1);
    std::atomic<bool> flag{};
    tree.stop_with(Stop(&flag));
    for (int query = 0; query < 10; ++query) {
      const Vec2 start = uniform_in(map.bounds(), rng);
      const std::vector<Vec2> path = whole.path_from(start);
      flag = true;
      const double length = tree.length_from(start);
      EXPECT_GE(length, (1 - 1e-12) * whole.length_from(start));
      stopped += tree.was_stopped();
      flag = false;
      EXPECT_EQ(tree.path_from(start), path);
      EXPECT_FALSE(tree.was_stopped());
    }
  }
  EXPECT_GT(stopped, 50);
}

TEST(ShortestPathTree, AGoalOutsideOrInAWallHasNoPaths) {
  const Map map({{0, 0}, {100, 100}}, {}, std::vector<Disc>{{{50, 50}, 10}});
  for (const Vec2 goal : {Vec2{200, 50}, Vec2{50, 50}, Vec2{infinity, 0}})
    EXPECT_EQ(ShortestPathTree(map, goal, 1).length_from({10, 10}), infinity);
}

}  // namespace
}  // namespace microswarm::planning
