// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "microswarm/navigation/gathering/rollout/rollout_changes.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_planning.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_search.hpp"
#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

/// A simulator for the T junction, robots there and the best plan of a base policy for them.
struct RolloutParts {
  const Gathering& t = t_junction();
  RolloutSimulator simulator{t.ground, t.stepper, t.params};
  Robots robots = t.robots(24, 3);
  RolloutExecution plan;

  RolloutParts() { plan.start(robots, shortest_base_plan(simulator, robots).value().plan); }

  /// All of the plan's moves from the checkpoint on.
  PartialPlan rest(std::size_t checkpoint) {
    PartialPlan partial{plan.checkpoints()[checkpoint],
                        checkpoint * RolloutPlan::checkpoint_interval};
    partial.keeps_checkpoints = true;
    return partial;
  }
};

TEST(RolloutExecution, RobotsThatFollowThePlanDoNotDeviateAndEndGathered) {
  RolloutParts p;
  while (p.plan.left() > 0) {
    const std::size_t left = p.plan.left();
    p.t.stepper.step(p.robots, p.plan.advance(p.t.stepper), ContactRule::stop);
    EXPECT_EQ(p.plan.left(), left - 1);
    EXPECT_EQ(p.plan.deviation(p.robots), 0);
  }
  EXPECT_TRUE(p.simulator.gathered(MergedRobots(p.robots)));
  p.robots.x[0] += 3;
  EXPECT_NEAR(p.plan.deviation(p.robots), 3, 1e-4);
}

TEST(RolloutExecution, OnlyAShorterPlanIsTaken) {
  RolloutParts p;
  const std::vector<Vec2> before(p.plan.moves().begin(), p.plan.moves().end());
  PartialPlan same = p.rest(1);
  p.simulator.follow(same, p.plan.moves().subspan(same.from), before.size());
  EXPECT_FALSE(p.plan.shorten(std::move(same)));
  EXPECT_EQ(p.plan.steps(), before.size());
  PartialPlan shorter = p.rest(1);
  p.simulator.follow(shorter, p.plan.moves().subspan(shorter.from), before.size() - 1);
  EXPECT_TRUE(p.plan.shorten(std::move(shorter)));
  EXPECT_EQ(p.plan.steps(), before.size() - 1);
  EXPECT_TRUE(std::equal(p.plan.moves().begin(), p.plan.moves().end(), before.begin()));
  EXPECT_EQ(p.plan.checkpoints().size(), (p.plan.steps() + RolloutPlan::checkpoint_interval - 1) /
                                             RolloutPlan::checkpoint_interval);
}

// So a path is simulated only from where it leaves the plan.
TEST(RolloutChanges, VerifyingFromALaterCheckpointIsTheSame) {
  RolloutParts p;
  constexpr std::size_t later = 3;
  constexpr std::size_t common = later * RolloutPlan::checkpoint_interval;
  std::vector<Vec2> moves(p.plan.moves().begin(), p.plan.moves().end());
  for (std::size_t left_out : {1, 5, 12}) {
    std::vector<Vec2> some = moves;
    some.erase(some.begin() + common + 2, some.begin() + common + 2 + left_out);
    const VerifiedPlan all = verified(0, some, p.plan, p.simulator);
    const VerifiedPlan rest =
        verified(common, std::span(some).subspan(common), p.plan, p.simulator);
    EXPECT_EQ(rest.is_shorter, all.is_shorter);
    EXPECT_EQ(rest.plan.steps(), all.plan.steps());
    EXPECT_EQ(rest.plan.merged.robots().x, all.plan.merged.robots().x);
    EXPECT_EQ(rest.checkpoints.size() + later, all.checkpoints.size());
  }
}

TEST(RolloutChanges, AChangedPlanIsShorterAndGathersTheRobots) {
  RolloutParts p;
  Rng rng(5, Purpose::planner);
  int found = 0;
  for (int k = 0; k < 20; ++k) {
    const auto shorter = best_change(p.plan, p.simulator, 16, rng);
    if (!shorter) continue;
    ++found;
    EXPECT_LT(shorter->steps(), p.plan.steps());
    Robots robots = p.robots;
    for (const Vec2 move : p.plan.moves().first(shorter->from))
      p.t.stepper.step(robots, move, ContactRule::stop);
    for (const Vec2 move : shorter->moves) p.t.stepper.step(robots, move, ContactRule::stop);
    EXPECT_TRUE(p.simulator.gathered(MergedRobots(robots)));
  }
  EXPECT_GT(found, 0);
}

// A policy that is paused goes on as if it were not.
TEST(RolloutPlanning, TheBasePlanIsTheShorterOne) {
  RolloutParts p;
  std::size_t shortest = 100'000;
  for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
    PartialPlan alone{MergedRobots(p.robots)};
    ASSERT_TRUE(p.simulator.finish(alone, method, shortest * 2));
    shortest = std::min(shortest, alone.steps());
  }
  EXPECT_EQ(p.plan.steps(), shortest);
}

TEST(RolloutPlanning, ACorrectedPlanGathersRobotsThatDeviated) {
  RolloutParts p;
  for (int k = 0; k < 20; ++k) p.plan.advance(p.t.stepper);
  const Robots others = p.t.robots(24, 4);
  const auto corrected = corrected_plan(p.simulator, others, p.plan.moves().subspan(p.plan.done()));
  ASSERT_TRUE(corrected);
  Robots robots = others;
  for (const Vec2 move : corrected->moves) p.t.stepper.step(robots, move, ContactRule::stop);
  EXPECT_TRUE(p.simulator.gathered(MergedRobots(robots)));
}

TEST(RolloutSearch, KeepsToItsBudgets) {
  RolloutParts p;
  AggregationParams params = p.t.params;
  params.rollout.max_work = 4e6;
  RolloutSimulator simulator(p.t.ground, p.t.stepper, params);
  RolloutSearch search(Rng(3, Purpose::planner));
  search.start(params.rollout);
  const std::size_t steps = p.plan.steps();
  search.improve(p.plan, simulator, 2e5, {});
  const double first = simulator.work();
  EXPECT_GE(first, 2e5);
  search.improve(p.plan, simulator, 1e9, {});
  const double second = simulator.work();
  EXPECT_GE(second, 4e6);
  EXPECT_LT(second, 5e6);
  search.improve(p.plan, simulator, 2e5, {});
  EXPECT_EQ(simulator.work(), second);  // `max_work` is spent
  EXPECT_GT(search.improvements(), 0);
  EXPECT_LT(p.plan.steps(), steps);
}

}  // namespace
}  // namespace microswarm::navigation
