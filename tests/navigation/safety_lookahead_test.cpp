// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/safety_lookahead.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "tests/navigation/discs.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

constexpr Aim far_away{.position = {1800, 500}};

bool is_safe(const HierarchicalParams& params, const SwarmLimits& swarm, const Snapshot& world,
             Vec2 from, const SafetyLookahead::Steering& steer) {
  const SafetyLookahead lookahead(params, swarm);
  ObstaclePredictor at_rest;
  at_rest.update({.swarm = SwarmPose{{from, 0}, swarm.radius}, .world = borrowed(world)});
  return lookahead.is_safe({world, at_rest, far_away, {from, 0}}, steer);
}

// Within a tick a swarm leaves the chord of its arc by v ω dt² / 8: at least 1 µm is kept for that.
TEST(SafetyLookahead, KeepsTheClearanceAndWhatATickMayAddFromObstacles) {
  const HierarchicalParams params;
  const auto hold = [](const Pose2&, double) { return Command{}; };
  for (const double turn_rate : {3.0, 20.0, 100.0, 400.0, infinity}) {
    const SwarmLimits swarm{.radius = 50, .max_speed = 80, .max_turn_rate = turn_rate};
    const double dt = params.tuning.check_step;
    const double slack =
        turn_rate < infinity ? std::max(1.0, params.speed * turn_rate * dt * dt / 8) : 1;
    const auto holds = [&](double gap) {
      const Snapshot world = room_with({}, {disc_body({600 + 60 + gap, 500}, 60)});
      return is_safe(params, swarm, world, {600, 500}, hold);
    };
    EXPECT_TRUE(holds(params.clearance + slack + 0.1)) << turn_rate;
    EXPECT_FALSE(holds(params.clearance + slack - 0.1)) << turn_rate;
  }
}

// A clearance that hardly exceeds the radius leaves no room for what happens within a tick.
TEST(SafetyLookahead, KeepsItsRadiusAndWhatATickMayAddFromWalls) {
  HierarchicalParams params;
  params.clearance = 50;
  const SwarmLimits swarm{.radius = 50, .max_speed = 80, .max_turn_rate = infinity};
  const Snapshot world = room_with();
  const auto ends_at = [&](double gap) {
    const double dt = params.tuning.check_step;
    const auto steer = [&](const Pose2& pose, double t) {
      return Command{-0.5 * pi, t < 0.5 * dt ? (pose.position.y - gap) / dt : 0};
    };
    return is_safe(params, swarm, world, {1000, 70}, steer);
  };
  EXPECT_TRUE(ends_at(51.2));
  EXPECT_FALSE(ends_at(50.8));
  params.clearance = 60;
  EXPECT_TRUE(ends_at(60.2));
  EXPECT_FALSE(ends_at(59.8));
}

}  // namespace
}  // namespace microswarm::navigation
