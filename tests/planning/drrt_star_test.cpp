// SPDX-License-Identifier: Apache-2.0
// D-RRT* that ends on the shortest path; the rest of it stands in the laws of planners.
#include "microswarm/planning/trees/drrt_star.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "microswarm/planning/exact/exact.hpp"
#include "microswarm/planning/trees/search_tree.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

DrrtStarParams params_for(double clearance) {
  DrrtStarParams params;
  params.clearance = clearance;
  params.goal_tolerance = 30;
  params.max_nodes = 1000;
  params.max_iterations = 2000;
  return params;
}

Plan plan_once(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params) {
  Rng rng(1, Purpose::planner);
  return plan(world, start, goal, params, rng);
}

Plan plan_exactly(const Snapshot& world, Pose2 start, Vec2 goal, double clearance) {
  Rng rng(1, Purpose::planner);
  return plan(world, start, goal, ExactParams{clearance, 30}, rng);
}

Plan without_route(const Snapshot& world, Pose2 start, Vec2 goal, DrrtStarParams params) {
  params.exact_route = false;
  return plan_once(world, start, goal, params);
}

/// A wall with a door of 30 µm at its lower end, and start and goal on both sides of it.
scenes::RawWorld world_with_door() {
  return {.name = {}, .walls = {scenes::rectangle({{480, 30}, {520, 700}})}};
}
constexpr Pose2 at_left{{100, 600}, 0};
constexpr Vec2 at_right{900, 600};

TEST(DrrtStarRoute, CostsNoMoreThanWithoutItAndHardlyMoreThanTheShortestPath) {
  const PathCost cost{DrrtStarParams{}.length_weight, DrrtStarParams{}.smoothness_weight};
  constexpr double clearance = 10;
  const DrrtStarParams params = params_for(clearance);
  int cheaper = 0, asked = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    Rng rng(5, Purpose::scene, trial);
    scenes::RawWorld raw = scenes::random_world(static_cast<int>(trial) % 4, rng);
    const Pose2 start{scenes::random_free_point(raw, clearance, rng), 1};
    const Vec2 goal = scenes::random_free_point(raw, clearance, rng);
    const Snapshot world = raw.snapshot();
    const Plan with = plan_once(world, start, goal, params);
    const Plan without = without_route(world, start, goal, params);
    const Plan shortest = plan_exactly(world, start, goal, clearance);
    ASSERT_EQ(with.status, shortest.status) << "trial " << trial;
    if (with.status != Status::solved || with.path.size() < 2) continue;
    ++asked;
    EXPECT_LE(distance(with.path.back(), goal), params.goal_tolerance);
    EXPECT_TRUE(world.is_free(with.path, clearance)) << "trial " << trial;
    const double here = cost.of(with.path, start.heading);
    EXPECT_LE(here, 1.0001 * cost.of(shortest.path, start.heading)) << "trial " << trial;
    if (without.status != Status::solved) continue;
    EXPECT_LE(here, cost.of(without.path, start.heading)) << "trial " << trial;
    cheaper += here < cost.of(without.path, start.heading) - 1;
  }
  EXPECT_GT(asked, 30);
  EXPECT_GT(cheaper, asked / 2);
}

TEST(DrrtStarRoute, GoesThroughADoorThatTheTreeDoesNotFind) {
  DrrtStarParams params = params_for(14);
  params.max_iterations = 20;
  const Snapshot world = world_with_door().snapshot();
  EXPECT_EQ(without_route(world, at_left, at_right, params).status, Status::node_limit);
  const Plan found = plan_once(world, at_left, at_right, params);
  ASSERT_EQ(found.status, Status::solved);
  EXPECT_TRUE(world.is_free(found.path, params.clearance));
  params.as_published = true;
  EXPECT_EQ(plan_once(world, at_left, at_right, params).status, Status::node_limit);
}

TEST(DrrtStarRoute, StaysWithTheTreeWhereSomethingThatMovesIsNear) {
  const DrrtStarParams params = params_for(10);
  scenes::RawWorld world = world_with_door();
  const double near = params.clearance + 0.5 * params.detection_diameter;
  const auto takes_route = [&](Disc mover) {
    world.movers = {mover};
    const Plan with = plan_once(world.snapshot(), at_left, at_right, params);
    EXPECT_EQ(with.status, Status::solved);
    return with.path != without_route(world.snapshot(), at_left, at_right, params).path;
  };
  // The route ends 30 µm before the goal.
  EXPECT_TRUE(takes_route({{at_right.x + 200, 690}, 5}));
  EXPECT_FALSE(takes_route({{at_right.x + near - 20, at_right.y}, 5}));
}

TEST(DrrtStarRoute, AStartOrAGoalAtTheClearanceIsNoHindrance) {
  const DrrtStarParams params = params_for(10);
  const Snapshot world = world_with_door().snapshot();
  for (const double heading : {0.0, 3.0})
    for (const auto& [start, goal] :
         {std::pair{Vec2{470, 300}, at_right}, {at_right, Vec2{470, 300}}}) {
      const Plan with = plan_once(world, {start, heading}, goal, params);
      ASSERT_EQ(with.status, Status::solved);
      EXPECT_TRUE(world.is_free(with.path, params.clearance));
      const Plan shortest = plan_exactly(world, {start, heading}, goal, params.clearance);
      EXPECT_LE(path_length(with.path), 1.0001 * path_length(shortest));
    }
}

TEST(DrrtStarRoute, ThatThereIsNoPathIsProvenAtOnceAndAFoundOneLimitsTheTree) {
  DrrtStarParams params = params_for(16);  // the door is 30 µm wide
  params.max_nodes = params.max_iterations = 10'000'000;
  const Snapshot world = world_with_door().snapshot();
  const Plan none = plan_once(world, at_left, at_right, params);
  EXPECT_EQ(none.status, Status::no_path);
  EXPECT_LE(none.tree.size(), 2u);
  params.clearance = 14.999;
  const Plan found = plan_once(world, at_left, at_right, params);
  EXPECT_EQ(found.status, Status::solved);
  EXPECT_LE(found.tree.size(), static_cast<std::size_t>(DrrtStarParams{}.max_nodes) + 1);
}

}  // namespace
}  // namespace microswarm::planning
