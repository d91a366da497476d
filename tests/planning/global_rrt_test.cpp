// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_rrt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/planning/global_input/coverage.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "tests/planning/global_ends.hpp"

namespace microswarm::planning {
namespace {

using scenes::global_world;

GlobalRrt grow(int world, std::size_t n, const GlobalRrtParams& params, std::uint64_t seed = 1) {
  Rng rng(seed, Purpose::planner);
  return global_rrt(scenes::global_world(world), starts(n), goals(n), params, rng);
}

double worst_distance(const GlobalTree& tree, std::uint32_t node, std::span<const Vec2> to) {
  double worst = 0;
  for (std::size_t i = 0; i < to.size(); ++i)
    worst = std::max(worst, distance(tree.position(node, i), to[i]));
  return worst;
}

void expect_edges_replay(const Map& map, const GlobalTree& tree) {
  const RobotStepper stepper = input_stepper(map, tree.robostep);
  for (std::uint32_t node = 1; node < tree.size(); ++node) {
    ASSERT_LT(tree.parents[node], node);
    const auto before = tree.configuration(tree.parents[node]);
    const auto after = tree.configuration(node);
    for (std::size_t i = 0; i < tree.robots; ++i) {
      const PointF p = stepper.moved({before[2 * i], before[2 * i + 1]},
                                     tree.moves[tree.inputs[node]], tree.contact);
      ASSERT_EQ(p.x, after[2 * i]);
      ASSERT_EQ(p.y, after[2 * i + 1]);
      ASSERT_TRUE(map.is_free(tree.position(node, i), 0));
    }
    ASSERT_FALSE(std::ranges::equal(before, after));
  }
}

TEST(GlobalRrt, EveryEdgeReplaysToTheBits) {
  for (int world = 1; world <= scenes::global_worlds; ++world) {
    const Map map = scenes::global_world(world);
    for (const std::size_t n : {1u, 2u, 3u, 8u}) {
      for (const ContactRule rule : {ContactRule::slide, ContactRule::stop, ContactRule::reject}) {
        GlobalRrtParams params;
        params.max_nodes = 1500;
        params.contact = rule;
        params.directions = world == 4 ? 4 : 16;
        params.stop_at_first = false;
        std::vector<Vec2> from;
        for (std::size_t i = 0; i < n; ++i) from.push_back({60.0 + 5 * double(i), 200});
        Rng rng(3, Purpose::planner);
        const GlobalRrt grown = global_rrt(map, from, from, params, rng);
        EXPECT_EQ(grown.tree.size(), 1500u);
        expect_edges_replay(map, grown.tree);
      }
    }
  }
}

TEST(GlobalRrt, SolvesOneAndTwoRobotsAndTheGoalIsMet) {
  for (const std::size_t n : {1u, 2u}) {
    const GlobalRrt grown = grow(1, n, {.max_nodes = 1'000'000}, 2);
    ASSERT_EQ(grown.answer.status, Status::solved);
    EXPECT_LE(worst_distance(grown.tree, grown.answer.node, goals(n)), 20);
    const GlobalPlan plan = plan_to(grown.tree, grown.answer);
    EXPECT_EQ(plan.configurations.size(), plan.inputs.size() + 1);
    EXPECT_EQ(plan.status, Status::solved);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_LT(distance(plan.configurations.front()[i], starts(n)[i]), 1e-4);
      EXPECT_LE(distance(plan.configurations.back()[i], goals(n)[i]), 20);
      for (std::size_t k = 0; k < plan.inputs.size(); ++k)
        EXPECT_LE(distance(plan.configurations[k][i], plan.configurations[k + 1][i]),
                  norm(plan.inputs[k]) + 1e-3);
    }
  }
}

TEST(GlobalRrt, SameSeedSameBits) {
  const GlobalRrt a = grow(3, 3, {.max_nodes = 4000}, 7);
  const GlobalRrt b = grow(3, 3, {.max_nodes = 4000}, 7);
  const GlobalRrt c = grow(3, 3, {.max_nodes = 4000}, 8);
  EXPECT_EQ(a.tree.configurations, b.tree.configurations);
  EXPECT_EQ(a.tree.parents, b.tree.parents);
  EXPECT_EQ(a.tree.inputs, b.tree.inputs);
  EXPECT_NE(a.tree.configurations, c.tree.configurations);
}

TEST(GlobalRrt, AGrownTreeAnswersOtherGoals) {
  for (const std::size_t n : {1u, 2u, 3u}) {
    const GlobalRrt grown = grow(2, n, {.max_nodes = 20'000, .stop_at_first = false});
    EXPECT_EQ(ask(grown.tree, goals(n), 20).node, grown.answer.node);
    Rng rng(5, Purpose::test);
    for (int k = 0; k < 20; ++k) {
      std::vector<Vec2> others;
      for (std::size_t i = 0; i < n; ++i) {
        const double x = rng.uniform(50, 350);
        others.push_back({x, rng.uniform(50, 350)});
      }
      const double tolerance = rng.uniform(5, 60);
      const GoalAnswer answer = ask(grown.tree, others, tolerance);
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t node = 0; node < grown.tree.size(); ++node)
        least = std::min(least, worst_distance(grown.tree, node, others));
      EXPECT_NEAR(answer.worst, least, 1e-9);
      EXPECT_NEAR(worst_distance(grown.tree, answer.node, others), least, 1e-9);
      EXPECT_EQ(answer.status, least <= tolerance ? Status::solved : Status::node_limit);
    }
  }
}

TEST(GlobalRrt, GrowsWithoutGoals) {
  Rng rng(1, Purpose::planner);
  const GlobalRrt grown =
      global_rrt(scenes::global_world(1), starts(2), {}, {.max_nodes = 3000}, rng);
  EXPECT_EQ(grown.tree.size(), 3000u);
  EXPECT_EQ(grown.answer.status, Status::node_limit);
}

TEST(GlobalRrt, GoalBiasHelpsOneRobot) {
  const GlobalRrt biased = grow(2, 1, {.goal_bias = 0.2});
  ASSERT_EQ(biased.answer.status, Status::solved);
  EXPECT_LE(biased.tree.size(), grow(2, 1, {}).tree.size());
}

TEST(GlobalRrt, StopsWhenToldAndAtItsLimits) {
  const Map map = scenes::global_world(1);
  Rng rng(1, Purpose::planner);
  const std::atomic<bool> flag{true};
  EXPECT_EQ(global_rrt(map, starts(3), goals(3), {}, rng, Stop(&flag)).answer.status,
            Status::stopped);
  const Stop soon(std::chrono::milliseconds(200));  // long enough for a busy computer
  const auto grown = global_rrt(map, starts(4), goals(4), {.max_nodes = 10'000'000}, rng, soon);
  EXPECT_EQ(grown.answer.status, Status::time_limit);
  EXPECT_GT(grown.tree.size(), 1u);
  EXPECT_EQ(grow(1, 4, {.max_nodes = 100}).tree.size(), 100u);
  EXPECT_EQ(grow(1, 4, {.max_nodes = 100}).answer.status, Status::node_limit);
  EXPECT_EQ(grow(1, 4, {.max_iterations = 50}).counts.iterations, 50u);
}

TEST(GlobalRrt, SaysWhatIsWrong) {
  const Map map = scenes::global_world(1);
  Rng rng(1, Purpose::planner);
  const auto status = [&](std::vector<Vec2> from, std::vector<Vec2> to) {
    return global_rrt(map, from, to, {.max_nodes = 100}, rng).answer.status;
  };
  EXPECT_EQ(status({{160, 200}}, {{100, 100}}), Status::start_blocked);
  EXPECT_EQ(status({{10, 200}}, {{100, 100}}), Status::start_blocked);
  EXPECT_EQ(status({{100, 200}}, {{20, 100}}), Status::goal_blocked);
  EXPECT_EQ(status({{100, 200}, {100, 100}}, {{100, 100}, {0, 0}}), Status::goal_blocked);
  EXPECT_EQ(status({{100, 200}}, {{100, 210}}), Status::solved);
  EXPECT_THROW(status({}, {}), InputError);
  EXPECT_THROW(status({{100, 200}}, {{100, 100}, {100, 120}}), InputError);
  EXPECT_THROW(status(std::vector<Vec2>(65, {100, 200}), std::vector<Vec2>(65, {100, 200})),
               InputError);
}

TEST(InputMoves, AxisDirectionsAreExact) {
  const std::vector<PointF> moves = input_moves(4, 5);
  ASSERT_EQ(moves.size(), 4u);
  EXPECT_EQ(moves[0].x, 5);
  EXPECT_EQ(moves[0].y, 0);
  EXPECT_EQ(moves[1].x, 0);
  EXPECT_EQ(moves[1].y, 5);
  EXPECT_EQ(moves[3].x, 0);
}

TEST(Coverage, SameAsCountingEveryHypercube) {
  for (const double cell : {30.0, 77.0}) {
    const Map map = scenes::global_world(3);
    const GlobalRrt grown = grow(3, 2, {.max_nodes = 3000, .stop_at_first = false});
    const Coverage found = coverage(map, grown.tree, cell);
    std::set<std::vector<int>> cubes;
    for (std::uint32_t node = 0; node < grown.tree.size(); ++node) {
      std::vector<int> cube;
      for (const Vec2 p : grown.tree.positions(node)) {
        cube.push_back(static_cast<int>((p.x - 50) / cell));
        cube.push_back(static_cast<int>((p.y - 50) / cell));
      }
      cubes.insert(cube);
    }
    EXPECT_EQ(found.occupied, cubes.size());
    // Rectangles 150…250 × 210…350 and 50…190 fill whole cells of 30.
    if (cell == 30) {
      EXPECT_EQ(found.free_cells, 100u - 2 * 8);
    }
    EXPECT_DOUBLE_EQ(found.share, double(cubes.size()) / std::pow(double(found.free_cells), 2));
  }
}

TEST(Coverage, RefusesCellsThatAreTooSmall) {
  EXPECT_THROW(coverage(scenes::global_world(1), {}, 0), InputError);
  EXPECT_THROW(coverage(scenes::global_world(1), {}, 1e-3), InputError);
}

}  // namespace
}  // namespace microswarm::planning
