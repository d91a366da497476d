// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/responding_robots.hpp"

#include <gtest/gtest.h>

#include "tests/cases.hpp"
#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

/// A gathering in which some robots never move.
struct WithDeadRobots {
  const Gathering& g;
  Robots robots;
  std::vector<std::size_t> dead;

  WithDeadRobots(const Gathering& of, int count, int dead_count, std::uint32_t trial)
      : g(of), robots(of.robots(count, trial)) {
    for (int k = 0; k < dead_count; ++k) dead.push_back(static_cast<std::size_t>(k));
  }
  /// Steps until they are gathered; nothing if they are not after `most`.
  std::optional<int> gather(AggregationPolicy& policy, int most) {
    for (int step = 0; step < most; ++step) {
      const auto move = policy.next(robots);
      if (!move) return step;
      const Robots before = robots;
      g.stepper.step(robots, *move, ContactRule::stop);
      for (const std::size_t i : dead) {
        robots.x[i] = before.x[i];
        robots.y[i] = before.y[i];
      }
    }
    return std::nullopt;
  }
};

// One dead robot of 128 led divide and conquer to the end in 16 of 20 trials, livelock guard or
// not.
TEST(RespondingRobots, ADeadRobotDoesNotLeadForEver) {
  const Gathering network(scenes::vascular_network());
  struct Case {
    const Gathering& g;
    int count, dead;
  };
  for (const Case& c : {Case{t_junction(), 128, 1}, Case{network, 300, 3}}) {
    for (const Aggregation method : {Aggregation::divide_and_conquer, Aggregation::heuristic,
                                     Aggregation::dynamic_shortest_path}) {
      AggregationParams params = c.g.params;
      params.method = method;
      for (std::uint32_t trial = 0; trial < test::cases(3U); ++trial) {
        WithDeadRobots swarm(c.g, c.count, c.dead, trial);
        AggregationPolicy policy(c.g.ground, params);
        const auto steps = swarm.gather(policy, 10'000);
        EXPECT_TRUE(steps) << enum_name(method) << ", trial " << trial;
      }
    }
  }
}

Robots at(std::vector<Vec2> places) {
  Robots robots;
  for (const Vec2 p : places) {
    robots.x.push_back(static_cast<float>(p.x));
    robots.y.push_back(static_cast<float>(p.y));
  }
  return robots;
}

// A wall at x = 100.
Map half_plane() {
  return {{{0, 0}, {200, 100}}, {Polygon{{{100, 0}, {200, 0}, {200, 100}, {100, 100}}, {}}}};
}

TEST(RespondingRobots, OneThatDoesNotFollowIsSetAsideUntilItMoves) {
  const Map map = half_plane();
  RespondingRobots responding(map, 1);
  Robots robots = at({{20, 50}, {30, 50}, {40, 50}});
  int moves = 0;
  for (; responding.aside().empty() && moves < 100; ++moves) {
    responding.update(robots, {});
    responding.judge_by(1, {1, 0});
    for (const std::size_t i : {0u, 2u}) robots.x[i] += 1;
    if (responding.update(robots, {})) break;
  }
  EXPECT_EQ(moves, 15);
  ASSERT_EQ(responding.aside().size(), 1u);
  EXPECT_EQ(responding.aside()[0], 1u);
  ASSERT_EQ(responding.robots().size(), 2u);
  EXPECT_EQ(responding.robots().position(1), robots.position(2));
  EXPECT_EQ(responding.original(0), 0u);
  EXPECT_EQ(responding.original(1), 2u);
  EXPECT_EQ(responding.original(RespondingRobots::nobody), RespondingRobots::nobody);
  robots.x[1] += 3.5F;
  EXPECT_FALSE(responding.update(robots, {}));
  robots.x[1] += 1;
  EXPECT_TRUE(responding.update(robots, {}));
  EXPECT_EQ(responding.robots().size(), 3u);
}

TEST(RespondingRobots, OneThatAWallHoldsIsNotJudged) {
  const Map map = half_plane();
  RespondingRobots responding(map, 1);
  const Robots robots = at({{99.9, 50}, {30, 50}});
  for (int k = 0; k < 200; ++k) {
    EXPECT_FALSE(responding.update(robots, {}));
    responding.judge_by(0, {1, 0});
  }
}

// Noise of half a step on each position makes neither of them look like the other.
TEST(RespondingRobots, SlowOnesRespondAndDeadOnesDoNotUnderNoise) {
  const Map map = half_plane();
  Rng rng(1, Purpose::test);
  for (int trial = 0; trial < 200; ++trial) {
    for (const double speed : {0.6, 0.0}) {
      RespondingRobots responding(map, 1);
      Robots robots = at({{20, 30}, {20, 60}});
      for (int k = 0; k <= 16; ++k) {
        Robots seen = robots;
        seen.x[0] += static_cast<float>(0.5 * rng.normal());
        responding.update(seen, {});
        EXPECT_EQ(responding.aside().empty(), k < 16 || speed > 0) << trial << ", " << k;
        responding.judge_by(0, {1, 0});
        robots.x[0] += static_cast<float>(speed);
      }
    }
  }
}

TEST(RespondingRobots, WithAnotherNumberOfRobotsAllRespondAgain) {
  const Map map = half_plane();
  RespondingRobots responding(map, 1);
  const Robots robots = at({{20, 50}, {30, 50}});
  while (responding.aside().empty()) {
    responding.update(robots, {});
    responding.judge_by(0, {1, 0});
  }
  const Robots more = at({{20, 50}, {30, 50}, {40, 50}});
  EXPECT_TRUE(responding.update(more, {}));
  EXPECT_EQ(responding.robots().size(), 3u);
}

TEST(RespondingRobots, IfNobodyRespondsAllAreJudgedAgain) {
  const Map map = half_plane();
  RespondingRobots responding(map, 1);
  const Robots robots = at({{20, 50}});
  for (int k = 0; k < 100; ++k) {
    responding.update(robots, {});
    EXPECT_EQ(responding.robots().size(), 1u);
    responding.judge_by(0, {1, 0});
  }
}

}  // namespace
}  // namespace microswarm::navigation
