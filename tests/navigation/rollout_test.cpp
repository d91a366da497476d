// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

AggregationParams with_work(const Gathering& g, double max_work) {
  AggregationParams params = g.params;
  params.rollout.budget = 2e5;
  params.rollout.first_budget = 2e5;
  params.rollout.max_work = max_work;
  return params;
}

int steps_of(const Gathering& g, Aggregation method, Robots robots) {
  AggregationParams params = g.params;
  params.method = method;
  AggregationPolicy policy(g.ground, params);
  return gather(g.stepper, policy, robots, 20'000).steps;
}

int best_base(const Gathering& g, const Robots& robots) {
  return std::min(steps_of(g, Aggregation::heuristic, robots),
                  steps_of(g, Aggregation::divide_and_conquer, robots));
}

TEST(Rollout, NeverTakesLongerThanItsBaseAndEndsThere) {
  const Gathering network(scenes::vascular_network());
  for (const Gathering* g : {&t_junction(), &network}) {
    for (const int count : {1, 2, 3, 16, 100}) {
      for (const double work : {1.0, 2e5, 1e6}) {
        Robots robots = g->robots(count, 4);
        const int base = best_base(*g, robots);
        const AggregationParams params = with_work(*g, work);
        RolloutPolicy policy(g->ground, g->stepper, params, Rng(3, Purpose::planner));
        const GatherResult result = gather(g->stepper, policy, robots, 20'000);
        EXPECT_EQ(result.status, Status::solved);
        EXPECT_LE(result.steps, base) << g->scene.name << " " << count << " " << work;
        EXPECT_LT(result.mean_distance, params.sigma);
        EXPECT_EQ(policy.replans(), 0);
        for (std::size_t i = 0; i < robots.size(); ++i)
          EXPECT_TRUE(g->ground.map.is_free(robots.position(i), 0));
      }
    }
  }
}

TEST(Rollout, TrialsMayBeShorterThanTheirUsualLeast) {
  const Gathering& t = t_junction();
  AggregationParams params = with_work(t, 1e6);
  params.rollout.horizon = 1;
  Robots robots = t.robots(16, 4);
  RolloutPolicy policy(t.ground, t.stepper, params, Rng(3, Purpose::planner));
  EXPECT_EQ(gather(t.stepper, policy, robots, 20'000).status, Status::solved);
}

// What it is for: HRA and DCA need more than 240 steps here.
TEST(Rollout, FindsMuchShorterPlans) {
  const Gathering& t = t_junction();
  double sum = 0;
  double base = 0;
  for (std::uint32_t trial = 0; trial < 4; ++trial) {
    Robots robots = t.robots(128, trial);
    base += best_base(t, robots);
    RolloutPolicy policy(t.ground, t.stepper, with_work(t, 4e6), Rng(3, Purpose::planner));
    sum += gather(t.stepper, policy, robots, 2000).steps;
    EXPECT_GT(policy.improvements(), 3);
  }
  EXPECT_LT(sum, 0.9 * base);
}

// Too little work for a usual pass over the layers.
TEST(Rollout, LittleWorkShortensLongPlansToo) {
  const Gathering network(scenes::vascular_network());
  double steps = 0;
  double base = 0;
  for (std::uint32_t trial = 0; trial < 3; ++trial) {
    Robots robots = network.robots(64, trial);
    base += best_base(network, robots);
    RolloutPolicy policy(network.ground, network.stepper, with_work(network, 6e5),
                         Rng(3, Purpose::planner));
    steps += gather(network.stepper, policy, robots, 20'000).steps;
  }
  EXPECT_LT(steps, base);
}

// The plan shrinks, never grows, while nothing disturbs it.
TEST(Rollout, StepsLeftOnlyShrink) {
  const Gathering& t = t_junction();
  Robots robots = t.robots(64, 2);
  RolloutPolicy policy(t.ground, t.stepper, with_work(t, 2e6), Rng(3, Purpose::planner));
  std::size_t left = 10'000;
  while (const auto move = policy.next(robots)) {
    EXPECT_LT(policy.steps_left(), left);
    left = policy.steps_left();
    t.stepper.step(robots, *move, ContactRule::stop);
  }
  EXPECT_EQ(left, 0u);
}

TEST(Rollout, SameSeedSameMoves) {
  const Gathering& t = t_junction();
  Robots one = t.robots(64, 5);
  Robots two = one;
  const AggregationParams params = with_work(t, 1e6);
  RolloutPolicy first(t.ground, t.stepper, params, Rng(3, Purpose::planner));
  RolloutPolicy second(t.ground, t.stepper, params, Rng(3, Purpose::planner));
  EXPECT_EQ(gather(t.stepper, first, one, 5000).steps, gather(t.stepper, second, two, 5000).steps);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
  EXPECT_EQ(first.work(), second.work());
}

TEST(Rollout, ThreadsChangeNothing) {
  const Gathering& t = t_junction();
  AggregationParams params = with_work(t, 2e6);
  params.rollout.first_budget = 2e6;
  std::vector<Robots> ends;
  std::vector<double> work;
  for (const int threads : {1, 2, 5}) {
    params.rollout.threads = threads;
    ends.push_back(t.robots(64, 5));
    RolloutPolicy policy(t.ground, t.stepper, params, Rng(3, Purpose::planner));
    gather(t.stepper, policy, ends.back(), 5000);
    EXPECT_GT(policy.improvements(), 0);
    EXPECT_EQ(ends.back().x, ends[0].x);
    EXPECT_EQ(ends.back().y, ends[0].y);
    work.push_back(policy.work());
    EXPECT_EQ(work.back(), work[0]);
  }
}

void shake(const RobotStepper& stepper, Robots& robots, double by, Rng& rng) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const double dx = by * rng.normal();
    const double dy = by * rng.normal();
    const PointF at =
        stepper.moved({robots.x[i], robots.y[i]}, {static_cast<float>(dx), static_cast<float>(dy)},
                      ContactRule::stop);
    robots.x[i] = at.x;
    robots.y[i] = at.y;
  }
}

TEST(Rollout, PlansAnewWhenRobotsStray) {
  const Gathering& t = t_junction();
  for (const double noise : {0.1, 0.2}) {
    Robots robots = t.robots(48, 7);
    Rng rng(9, Purpose::plant);
    RolloutPolicy policy(t.ground, t.stepper, with_work(t, 5e5), Rng(3, Purpose::planner));
    int steps = 0;
    for (; steps < 3000; ++steps) {
      const auto move = policy.next(robots);
      if (!move) break;
      t.stepper.step(robots, *move, ContactRule::stop);
      shake(t.stepper, robots, noise, rng);
    }
    EXPECT_LT(steps, 3000) << noise;
    EXPECT_LT(policy.mean_distance(), t.params.sigma);
    EXPECT_GT(policy.replans(), 0);
  }
}

// Another swarm is another task.
TEST(Rollout, BeginsAnewWithAnotherSwarm) {
  const Gathering& t = t_junction();
  RolloutPolicy policy(t.ground, t.stepper, with_work(t, 1e5), Rng(3, Purpose::planner));
  Robots many = t.robots(30, 1);
  ASSERT_TRUE(policy.next(many));
  Robots few = t.robots(10, 2);
  EXPECT_EQ(gather(t.stepper, policy, few, 2000).status, Status::solved);
}

// Robots that no input moves: no plan holds, yet it always has a move to give.
TEST(Rollout, GoesOnWhenNothingHelps) {
  const Gathering& t = t_junction();
  AggregationParams params = with_work(t, 1e5);
  params.rollout.max_steps = 50;  // no plan is as short
  RolloutPolicy policy(t.ground, t.stepper, params, Rng(3, Purpose::planner));
  const Robots robots = t.robots(8, 1);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(policy.next(robots));
  EXPECT_EQ(policy.steps_left(), 0u);
  Robots moving = robots;
  EXPECT_EQ(gather(t.stepper, policy, moving, 3000).status, Status::solved);
}

TEST(Rollout, OfNobodyAndOfOne) {
  const Gathering& t = t_junction();
  RolloutPolicy policy(t.ground, t.stepper, with_work(t, 1e5), Rng(3, Purpose::planner));
  EXPECT_EQ(policy.next(t.robots(0, 1)), std::nullopt);
  Robots one = t.stepper.place(std::vector<Vec2>{{50, 56}});
  EXPECT_EQ(policy.next(one), std::nullopt);  // gathered already
  EXPECT_LT(policy.mean_distance(), t.params.sigma);
}

TEST(Rollout, StopEndsTheThinkingOnly) {
  const Gathering& t = t_junction();
  const std::atomic<bool> stop{true};
  RolloutPolicy policy(t.ground, t.stepper, with_work(t, 1e6), Rng(3, Purpose::planner));
  EXPECT_TRUE(policy.next(t.robots(16, 1), Stop(&stop)));
  EXPECT_EQ(policy.improvements(), 0);
  EXPECT_GT(policy.steps_left(), 0u);
}

}  // namespace
}  // namespace microswarm::navigation
