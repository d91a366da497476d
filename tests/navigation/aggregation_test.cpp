// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "microswarm/core/errors/error.hpp"
#include "tests/cases.hpp"
#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

AggregationParams plain_params() {
  AggregationParams params;
  params.obstacle_weighted = false;
  return params;
}

TEST(Aggregation, GathersWithEveryMethod) {
  const Gathering plain(scenes::t_junction(), plain_params(), 1);
  for (const Gathering* g : {&t_junction(), &plain}) {
    const Gathering& t = *g;
    for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
      for (const int count : {1, 2, 16, 128}) {
        AggregationParams params = t.params;
        params.method = method;
        Robots robots = t.robots(count, 3);
        AggregationPolicy policy(t.ground, params);
        const GatherResult result = gather(t.stepper, policy, robots, 5000);
        ASSERT_EQ(result.status, Status::solved) << count;
        EXPECT_LT(result.mean_distance, params.sigma);
        for (std::size_t i = 0; i < robots.size(); ++i)
          EXPECT_TRUE(t.ground.map.is_free(robots.position(i), 0));
      }
    }
  }
}

// On the published T-junction the published means are 287 (DCA) and 597 (HRA) for n = 64.
TEST(Aggregation, RegionByRegionIsQuickerThanRobotByRobot) {
  const Gathering& t = t_junction();
  const auto mean_steps = [&](Aggregation method) {
    AggregationParams params = t.params;
    params.method = method;
    double sum = 0;
    for (std::uint32_t trial = 0; trial < 10; ++trial) {
      Robots robots = t.robots(64, trial);
      AggregationPolicy policy(t.ground, params);
      sum += gather(t.stepper, policy, robots, 5000).steps;
    }
    return sum / 10;
  };
  EXPECT_LT(mean_steps(Aggregation::divide_and_conquer), 330);
  EXPECT_LT(mean_steps(Aggregation::divide_and_conquer), mean_steps(Aggregation::heuristic));
}

scenes::Vascular generated(std::uint32_t number) {
  scenes::VascularShape shape;
  if (number % 2 == 1) shape.width = 160, shape.height = 120;
  Rng rng(number, Purpose::scene);
  return scenes::random_vascular(shape, rng);
}

// Before the map shrank region by region, two regions handed the same robots to and fro for ever.
TEST(Aggregation, NoLivelock) {
  std::vector<scenes::Vascular> maps{scenes::t_junction(), scenes::vascular_network()};
  for (std::uint32_t number = 0; number < test::cases(6U); ++number)
    maps.push_back(generated(number));
  for (const scenes::Vascular& map : maps) {
    const Gathering g(map);
    for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
      AggregationParams params = g.params;
      params.method = method;
      for (const int count : {2, 16, 256}) {
        for (const std::uint32_t trial : {1u, 2u}) {
          Robots robots = g.robots(count, trial);
          AggregationPolicy policy(g.ground, params);
          const GatherResult result = gather(g.stepper, policy, robots, 10'000);
          EXPECT_EQ(result.status, Status::solved) << map.name << " " << count << " " << trial;
        }
      }
    }
  }
}

// Robots that no input moves: the guard says so, seldom and more seldom.
TEST(Aggregation, TheGuardFiresWhenNothingHelps) {
  const Gathering& t = t_junction();
  AggregationPolicy policy(t.ground, t.params);
  const Robots robots = t.robots(8, 1);  // which never move
  for (int i = 0; i < 20'000; ++i) ASSERT_TRUE(policy.next(robots));
  EXPECT_GE(policy.guard_count(), 1);
  EXPECT_LE(policy.guard_count(), 10);
}

TEST(Aggregation, SameRobotsSameBits) {
  const Gathering& t = t_junction();
  Robots one = t.robots(32, 5);
  Robots two = one;
  AggregationPolicy first(t.ground, t.params);
  AggregationPolicy second(t.ground, t.params);
  EXPECT_EQ(gather(t.stepper, first, one, 5000).steps, gather(t.stepper, second, two, 5000).steps);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
}

// A simulation joins robots that meet, and looks only at those that moved.
TEST(Aggregation, IsTheSameRobotByRobot) {
  const Gathering& t = t_junction();
  for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
    AggregationParams params = t.params;
    params.method = method;
    Robots joined = t.robots(200, 6);
    Robots single = joined;
    AggregationPolicy policy(t.ground, params);
    const GatherResult result = gather(t.stepper, policy, joined, 5000);
    AggregationPolicy naive(t.ground, params);
    int steps = 0;
    for (; steps < 5000; ++steps) {
      const auto move = naive.next(single);
      if (!move) break;
      t.stepper.step(single, *move, ContactRule::stop);
    }
    EXPECT_EQ(steps, result.steps);
    EXPECT_EQ(naive.mean_distance(), result.mean_distance);
    EXPECT_EQ(joined.x, single.x);
    EXPECT_EQ(joined.y, single.y);
  }
}

TEST(Aggregation, EndsWhenToldAndWhenTheStepsRunOut) {
  const Gathering& t = t_junction();
  Robots robots = t.robots(32, 5);
  AggregationPolicy policy(t.ground, t.params);
  EXPECT_EQ(gather(t.stepper, policy, robots, 7).status, Status::time_limit);
  const std::atomic<bool> stop{true};
  const GatherResult stopped = gather(t.stepper, policy, robots, 7, Stop(&stop));
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_EQ(stopped.steps, 0);
}

TEST(Aggregation, NobodyIsLedNowhere) {
  const Gathering& t = t_junction();
  Robots none = t.robots(0, 1);
  AggregationPolicy policy(t.ground, t.params);
  EXPECT_EQ(policy.next(none), std::nullopt);
}

TEST(Aggregation, AGoalInAWallIsRefused) {
  Rng rng(1, Purpose::planner);
  EXPECT_THROW(AggregationMap(scenes::t_junction().map(), {10, 60}, AggregationParams{}, rng),
               InputError);
}

}  // namespace
}  // namespace microswarm::navigation
