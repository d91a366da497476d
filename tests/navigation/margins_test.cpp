// SPDX-License-Identifier: Apache-2.0
// Margins of the navigators for what moves during the delay, between two samples and within a tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/baselines/potential_field.hpp"
#include "microswarm/navigation/hierarchical/hierarchical.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "tests/navigation/discs.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

constexpr SwarmLimits late_vortex{
    .radius = 50, .max_speed = 80, .max_turn_rate = infinity, .response_lag = 0.1};

Observation frame_of(const Snapshot& world, const Pose2& pose, double seen, double age) {
  return {.now = seen + age,
          .seen = seen,
          .swarm = SwarmPose{pose, 50},
          .robots = {},
          .world = borrowed(world)};
}

// An obstacle that may approach at 40 µm/s for 0.3 s is as one that is larger by 12 µm.
TEST(Margins, RadarScreensWhatMayApproachDuringTheDelayAsIfItWereLarger) {
  RadarParams moving;
  moving.retreat = false;
  moving.safety_filter.active = false;
  moving.angle_step = pi / 36;
  RadarParams still = moving;
  moving.obstacle_speed_bound = 40;
  Rng rng(1, Purpose::test);
  int avoided = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec2 at{600, 500};
    const Vec2 disc = at + rng.uniform(100, 190) * unit_vector(rng.uniform(-1, 1));
    const auto command = [&](const RadarParams& params, double r) {
      RadarNavigator navigator(params, body_task(late_vortex), Rng(1, Purpose::planner));
      const Snapshot world = room_with({}, {disc_body(disc, r)});
      const Command c = navigator.step(frame_of(world, {at, 0}, 1, 0.2), {});
      avoided += navigator.view().state == NavigatorState::avoid;
      return c;
    };
    const Command late = command(moving, 30);
    const Command larger = command(still, 42);
    EXPECT_EQ(late.speed, larger.speed) << k;
    EXPECT_NEAR(late.heading, larger.heading, 1e-9) << k;
  }
  EXPECT_GT(avoided, 30);
}

/// A radar that sees next to nothing: only its safety filter is left.
RadarParams blind_radar() {
  RadarParams params;
  params.detection_range = 1e-3;
  params.safety_distance = 0;
  params.safety_filter.commitment = 0;
  return params;
}

// A disc that comes at it is foreseen, whether or not the swarm is found in the frame.
TEST(Margins, RadarKeepsOutOfTheWayOverFramesWithoutASwarm) {
  const auto map = room_with().shared_map();
  RadarNavigator navigator(blind_radar(), body_task(late_vortex, {600, 500}),
                           Rng(1, Purpose::planner));
  int guarded = 0;
  for (int k = 0; k <= 12; ++k) {
    const double t = 0.1 * k;
    const Snapshot world(map, t, {disc_body({800 - 60 * t, 505}, 60)});
    Observation seen = frame_of(world, {{600, 500}, 0}, t, 0);
    if (k > 8) seen.swarm.reset();
    navigator.step(seen, {});
    guarded += k > 8 && navigator.view().state == NavigatorState::guard;
    navigator.overruled(t, {0, 0});
  }
  EXPECT_GE(guarded, 2);
}

// The first one too lasts a tick, though there is none before it to tell how long that is.
TEST(Margins, RadarChecksItsFirstCommandForATick) {
  const auto goes_straight = [](double gap) {
    RadarNavigator navigator(blind_radar(), body_task(late_vortex), Rng(1, Purpose::planner));
    const Snapshot world = room_with({}, {disc_body({600 + 50 + 60 + gap, 500}, 60)});
    navigator.step(frame_of(world, {{600, 500}, 0}, 0, 0), {});
    return navigator.view().state == NavigatorState::direct;
  };
  for (const double gap : {14.0, 18.0}) EXPECT_FALSE(goes_straight(gap)) << gap;
  for (const double gap : {22.0, 26.0}) EXPECT_TRUE(goes_straight(gap)) << gap;
}

TEST(Margins, PotentialFieldIsPushedByAnOutlineAsItWillBeAfterTheDelay) {
  constexpr double growth = 20;  // [µm/s]
  const auto command = [&](double smaller, double age) {
    PotentialFieldNavigator navigator({}, body_task(late_vortex), Rng(1, Purpose::planner));
    Command last;
    for (int k = 0; k < 20; ++k) {
      const double t = 0.1 * k;
      const Snapshot world = room_with({}, {disc_body({780, 560}, 20 + growth * t - smaller)});
      if (k == 0) navigator.prepare(world, {});
      last = navigator.step(frame_of(world, {{600, 500}, 0}, t, k < 19 ? 0 : age), {});
      navigator.overruled(t, {0, 0});  // it stays where it is
    }
    return last;
  };
  const Command late = command(growth * 0.2, 0.2);
  const Command at_once = command(0, 0);
  EXPECT_NEAR(late.heading, at_once.heading, 1e-9);
  EXPECT_NEAR(late.speed, at_once.speed, 1e-9);
  EXPECT_NE(command(0, 0.2).heading, at_once.heading) << "it feels the disc";
}

/// What it does in a pocket that is open behind it, with as much room to each of its walls.
NavigatorState state_in_a_pocket(double room, const SwarmLimits& swarm) {
  HierarchicalParams params;
  params.guide = Guide::straight;
  const Vec2 at{600, 500};
  const auto bar = [&](Vec2 lo, Vec2 hi, std::uint32_t number) {
    const std::vector<Vec2> outline{at + lo, at + Vec2{hi.x, lo.y}, at + hi, at + Vec2{lo.x, hi.y}};
    return Body{.shape = Polygon{outline, {}}, .obstacle = number};
  };
  const Snapshot world =
      room_with({}, {bar({room, -200}, {room + 20, 200}, 0), bar({-40, room}, {room, room + 20}, 1),
                     bar({-40, -room - 20}, {room, -room}, 2)});
  HierarchicalNavigator navigator(params, body_task(swarm), Rng(1, Purpose::planner));
  navigator.prepare(world, {});
  navigator.step(frame_of(world, {at, 0}, 0, 0), {});
  return navigator.view().state;
}

// Where less clearance is left, it escapes rather than follows or holds. Within a tick a
// swarm leaves the chord of its arc by v ω dt² / 8.
TEST(Margins, HierarchicalKeepsTheClearanceWithinATickToo) {
  SwarmLimits swarm = late_vortex;
  for (const double turn_rate : {infinity, 100.0}) {
    swarm.max_turn_rate = turn_rate;
    const double slack = turn_rate == 100 ? 60 * 100 * 0.1 * 0.1 / 8 : 1;
    EXPECT_NE(state_in_a_pocket(90 + slack + 0.1, swarm), NavigatorState::escape) << turn_rate;
    EXPECT_EQ(state_in_a_pocket(90 + slack - 0.1, swarm), NavigatorState::escape) << turn_rate;
  }
}

// Everything beyond the horizon looks free: before discs that cross without end, each seen once it
// is near, to wait a little longer would always look better.
TEST(Margins, HierarchicalWaitsNoLongerThanItsHorizon) {
  HierarchicalParams params;
  params.guide = Guide::straight;
  const auto map = room_with().shared_map();
  SwarmLimits swarm = late_vortex;
  swarm.response_lag = 0;
  for (const double apart : {200.0, 300.0}) {
    HierarchicalNavigator navigator(params, body_task(swarm), Rng(1, Purpose::planner));
    Pose2 pose{{600, 500}, 0};
    double held = 0, longest = 0;
    for (int k = 0; k < 250; ++k) {
      const double t = 0.1 * k;
      std::vector<Body> discs;
      for (std::uint32_t i = 0; i < 80; ++i) {
        const double y = (i - 40.0) * apart + 100 * t;
        if (y > -200 && y < 1200) discs.push_back(disc_body({1000, y}, 60, i));
      }
      const Snapshot world(map, t, std::move(discs));
      if (k == 0) navigator.prepare(world, {});
      const Command command = navigator.step(frame_of(world, pose, t, 0), {});
      pose = unicycle_step(pose, command, infinity, 0.1);
      held = command.speed == 0 ? held + 0.1 : 0;
      longest = std::max(longest, held);
    }
    EXPECT_GT(longest, 1) << apart << " µm apart";
    EXPECT_LE(longest, params.target_horizon + 0.15) << apart << " µm apart";
  }
}

}  // namespace
}  // namespace microswarm::navigation
