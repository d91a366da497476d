// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/reachable_obstacles.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/navigation/discs.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

constexpr double escape_speed = 80;
constexpr double swarm_radius = 50;

/// Whether a disc `far` away from the swarm, from edge to edge, is looked at; it comes nearer and
/// grows.
bool is_foreseen(double far, double speed, double growth = 0) {
  const SafetyFilterParams params;
  ReachableObstacles seen(params, escape_speed);
  ObstacleTracker tracker(params.tracker);
  const Vec2 position{600, 500};
  constexpr double dead_time = 0.1;
  const auto map = room_with().shared_map();
  std::optional<Snapshot> world;
  for (int k = -10; k <= 0; ++k) {
    const double t = 0.1 * k;
    const double radius = 60 + t * growth;
    const double away = far + swarm_radius + 60 - t * speed;
    world.emplace(map, t, std::vector<Body>{disc_body(position + Vec2{away, 0}, radius)});
    tracker.update({.now = t,
                    .seen = t,
                    .swarm = SwarmPose{{position, 0}, swarm_radius},
                    .robots = {},
                    .world = borrowed(*world)});
  }
  seen.predict({position, swarm_radius, dead_time}, *world, tracker, escape_speed);
  return !seen.empty();
}

// Swarm and body towards each other until the horizon, plus the uncertainty and the gap.
TEST(ReachableObstacles, LooksAtWhatCanComeTooNearWithinTheHorizon) {
  const SafetyFilterParams params;
  const double seconds = params.horizon + 0.1;
  for (const double speed : {0.0, 40.0, 100.0})
    for (const double growth : {0.0, 20.0}) {
      const double reach = params.gap + (escape_speed + speed + params.gap_rate) * seconds +
                           growth * params.tuning.growth_time;
      EXPECT_TRUE(is_foreseen(reach - 0.1, speed, growth)) << speed << ", " << growth;
      EXPECT_FALSE(is_foreseen(reach + 0.1, speed, growth)) << speed << ", " << growth;
    }
}

// As far as one comes that is twice as fast as the swarm, which comes to meet it.
TEST(ReachableObstacles, ButNotFartherThanItsRange) {
  const SafetyFilterParams params;
  const double range = 3 * escape_speed * (params.horizon + params.tuning.max_dead_time);
  EXPECT_DOUBLE_EQ(ReachableObstacles(params, escape_speed).range(), range);
  EXPECT_TRUE(is_foreseen(range - 0.1, 4 * escape_speed));
  EXPECT_FALSE(is_foreseen(range + 0.1, 4 * escape_speed));
}

}  // namespace
}  // namespace microswarm::navigation
