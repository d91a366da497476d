// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/navigation/discs.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

constexpr double radar_tick = 0.1;
constexpr double radar_radius = 100;
constexpr SwarmLimits radar_vortex{.radius = radar_radius,
                                   .max_speed = 85,
                                   .max_turn_rate = std::numeric_limits<double>::infinity(),
                                   .response_lag = 0};

std::shared_ptr<const Map> radar_room(std::vector<Polygon> walls = {}) {
  return std::make_shared<const Map>(Box{{0, 0}, {3000, 1500}}, std::move(walls));
}

/// What became of a swarm that was steered for a while.
struct Trip {
  bool arrived = false;
  double min_gap = 1e9;  ///< from its edge to obstacles, walls and border
  double time = 0;
  std::vector<NavigatorState> states;

  bool was(NavigatorState state) const {
    return std::find(states.begin(), states.end(), state) != states.end();
  }
};

using Movers = std::function<std::vector<Body>(double t)>;

Trip drive(const RadarParams& params, Vec2 start, Vec2 goal, std::shared_ptr<const Map> map,
           const Movers& movers, double max_seconds = 120) {
  RadarNavigator navigator(params, body_task(radar_vortex, goal, 20), Rng(1, Purpose::planner));
  Trip trip;
  Pose2 pose{start, 0};
  for (; trip.time < max_seconds; trip.time += radar_tick) {
    const Snapshot world(map, trip.time, movers(trip.time));
    trip.min_gap = std::min(trip.min_gap, world.clearance(pose.position) - radar_radius);
    trip.arrived = distance(pose.position, goal) <= 20;
    if (trip.arrived) break;
    const Command c = navigator.step({.now = trip.time,
                                      .seen = trip.time,
                                      .swarm = SwarmPose{pose, radar_radius},
                                      .robots = {},
                                      .world = borrowed(world)},
                                     {});
    trip.states.push_back(navigator.view().state);
    pose = unicycle_step(pose, c, radar_vortex.max_turn_rate, radar_tick);
  }
  return trip;
}

std::vector<Body> nothing(double) { return {}; }

TEST(Radar, GoesStraightWhereNothingIs) {
  const Trip trip = drive({}, {300, 700}, {2700, 800}, radar_room(), nothing);
  EXPECT_TRUE(trip.arrived);
  EXPECT_FALSE(trip.was(NavigatorState::avoid));
  EXPECT_NEAR(trip.time, (distance(Vec2{300, 700}, Vec2{2700, 800}) - 20) / 85, 2 * radar_tick);
}

TEST(Radar, AvoidsWhatStandsInTheWay) {
  const Trip trip = drive({}, {300, 700}, {2700, 700}, radar_room(), [](double) {
    return std::vector{disc_body({1500, 690}, 150)};
  });
  EXPECT_TRUE(trip.arrived);
  EXPECT_TRUE(trip.was(NavigatorState::avoid));
  EXPECT_GT(trip.min_gap, 15);  // d_f less what a tick and the step take
}

Body box(Vec2 middle, double width, double height) {
  return {.shape = scenes::rectangle(
              {middle - 0.5 * Vec2{width, height}, middle + 0.5 * Vec2{width, height}})};
}

TEST(Radar, GetsRoundWhatIsFlat) {
  for (const Vec2 size : {Vec2{100, 100}, Vec2{30, 300}, Vec2{300, 300}}) {
    const Trip trip = drive({}, {300, 750}, {2700, 750}, radar_room(), [&](double) {
      return std::vector{box({1500, 750}, size.x, size.y)};
    });
    EXPECT_TRUE(trip.arrived) << size.x << " × " << size.y;
    EXPECT_GT(trip.min_gap, 0);
  }
}

TEST(Radar, AvoidsWhatCrossesAndWhatComes) {
  for (const Vec2 v : {Vec2{0, -40}, Vec2{0, 40}, Vec2{-40, 0}, Vec2{-30, 30}}) {
    const Trip trip = drive({}, {300, 700}, {2700, 720}, radar_room(), [&](double t) {
      return std::vector{disc_body(Vec2{1500, 700} + (t - 14) * v, 150)};
    });
    EXPECT_TRUE(trip.arrived);
    EXPECT_GT(trip.min_gap, 0) << v.x << ", " << v.y;
  }
}

TEST(Radar, GivesWayWhereItWaits) {
  // At its goal already, and something comes over it.
  RadarParams params;
  RadarNavigator navigator(params, body_task(radar_vortex, {1500, 700}, 30),
                           Rng(1, Purpose::planner));
  Pose2 pose{{1500, 700}, 0};
  const auto map = radar_room();
  double least = 1e9;
  for (int k = 0; k < 400; ++k) {
    const double t = radar_tick * k;
    const Snapshot world(map, t, {disc_body({1500 + 600 - 40 * t, 710}, 150)});
    const Command c = navigator.step({.now = t,
                                      .seen = t,
                                      .swarm = SwarmPose{pose, radar_radius},
                                      .robots = {},
                                      .world = borrowed(world)},
                                     {});
    pose = unicycle_step(pose, c, radar_vortex.max_turn_rate, radar_tick);
    least = std::min(least, world.clearance(pose.position) - radar_radius);
  }
  EXPECT_GT(least, 0);
}

TEST(Radar, WithoutRetreatItHoldsAsPublished) {
  // Obstacles on both sides, within the safety circle: no direction is safe.
  const std::vector<Body> both{disc_body({1700, 700}, 80, 0), disc_body({1300, 700}, 80, 1)};
  const Snapshot world(radar_room(), 0, both);
  for (const bool retreat : {false, true}) {
    RadarParams params;
    params.safety_distance = 80;
    params.detection_range = 120;
    params.retreat = retreat;
    params.safety_filter.active = retreat;
    RadarNavigator navigator(params, body_task(radar_vortex, {2700, 700}, 30),
                             Rng(1, Purpose::planner));
    const Command c = navigator.step({.now = 0,
                                      .seen = 0,
                                      .swarm = SwarmPose{{{1500, 700}, 0}, radar_radius},
                                      .robots = {},
                                      .world = borrowed(world)},
                                     {});
    EXPECT_EQ(c.speed > 0, retreat);
    EXPECT_EQ(navigator.view().state, retreat ? NavigatorState::retreat : NavigatorState::hold);
  }
}

TEST(Radar, AsPublishedOverridesWhatIsOurs) {
  RadarParams by_hand;
  by_hand.retreat = by_hand.safety_filter.active = by_hand.compensate_delay = false;
  by_hand.max_turn = pi;
  RadarParams by_key;
  by_key.as_published = true;
  by_key.obstacle_speed_bound = 50;
  SwarmLimits slow = radar_vortex;
  slow.response_lag = 0.2;
  const auto map = radar_room();
  const auto commands = [&](const RadarParams& params) {
    RadarNavigator navigator(params, body_task(slow, {2700, 720}, 20), Rng(1, Purpose::planner));
    Pose2 pose{{300, 700}, 0};
    std::vector<double> out;
    for (int k = 0; k < 300; ++k) {
      const double t = radar_tick * k;
      const Snapshot world(map, t,
                           {disc_body({1300 - 30 * t, 700}, 150), disc_body({1600, 560}, 100, 1)});
      const Command c = navigator.step({.now = t,
                                        .seen = t - 0.05,
                                        .swarm = SwarmPose{pose, radar_radius},
                                        .robots = {},
                                        .world = borrowed(world)},
                                       {});
      out.push_back(c.heading);
      out.push_back(c.speed);
      pose = unicycle_step(pose, c, radar_vortex.max_turn_rate, radar_tick);
    }
    return out;
  };
  EXPECT_EQ(commands(by_key), commands(by_hand));
  EXPECT_NE(commands(by_key), commands({}));
}

TEST(Radar, FollowsWaypointsRoundAWall) {
  const auto map = radar_room({scenes::rectangle({{1400, 0}, {1450, 1000}})});
  RadarParams params;
  const Trip blind = drive(params, {700, 400}, {2300, 400}, map, nothing);
  EXPECT_FALSE(blind.arrived);
  EXPECT_TRUE(blind.was(NavigatorState::stuck));
  EXPECT_GT(blind.min_gap, 0);
  params.waypoints = {{1300, 1250}, {1600, 1250}};
  const Trip by_hand = drive(params, {700, 400}, {2300, 400}, map, nothing);
  EXPECT_TRUE(by_hand.arrived);
  EXPECT_GT(by_hand.min_gap, 0);
  params.waypoints.clear();
  params.global_plan = true;
  params.planner.clearance = 140;
  const Trip planned = drive(params, {700, 400}, {2300, 400}, map, nothing);
  EXPECT_TRUE(planned.arrived);
  EXPECT_GT(planned.min_gap, 0);
}

TEST(Radar, IsStuckWithoutAPlan) {
  const auto map = radar_room({scenes::rectangle({{1400, 0}, {1450, 1500}})});
  RadarParams params;
  params.global_plan = true;
  params.planner.max_nodes = 2000;
  const Trip trip = drive(params, {700, 400}, {2300, 400}, map, nothing, 3);
  EXPECT_EQ(trip.states.front(), NavigatorState::stuck);
  EXPECT_FALSE(trip.was(NavigatorState::direct));
}

/// A room in two halves without a door, and the halves again joined by one.
std::shared_ptr<const Map> halved_room(double wall_top) {
  return radar_room({scenes::rectangle({{1400, 0}, {1450, wall_top}})});
}

TEST(Radar, APlanThatFailedIsTriedAgain) {
  // The first frames show the swarm where there is no way to the goal: in the other half.
  const auto map = halved_room(1500);
  RadarParams params;
  params.global_plan = true;
  params.planner.max_nodes = 1000;
  RadarNavigator navigator(params, body_task(radar_vortex, {2300, 400}, 20),
                           Rng(1, Purpose::planner));
  const Snapshot world(map, 0);
  int plans = 0;
  for (int k = 0; k < 40; ++k) {
    const double now = radar_tick * k;
    const Vec2 seen_at = k < 5 ? Vec2{700, 400} : Vec2{1800, 400};
    const Command c = navigator.step({.now = now,
                                      .seen = now,
                                      .swarm = SwarmPose{{seen_at, 0}, radar_radius},
                                      .robots = {},
                                      .world = borrowed(world)},
                                     {});
    plans += navigator.view().planned;
    if (now < 1) {
      EXPECT_EQ(navigator.view().state, NavigatorState::stuck) << now;
    } else {
      EXPECT_GT(c.speed, 0) << now;
    }
  }
  EXPECT_EQ(plans, 2);
}

TEST(Radar, WithoutAWayItPlansEverMoreSeldom) {
  const Snapshot world(halved_room(1500), 0);
  RadarParams params;
  params.global_plan = true;
  params.planner.max_nodes = 1000;
  RadarNavigator navigator(params, body_task(radar_vortex, {2300, 400}, 20),
                           Rng(1, Purpose::planner));
  std::vector<double> planned;
  for (int k = 0; k < 1300; ++k) {
    const double now = radar_tick * k;
    navigator.step({.now = now,
                    .seen = now,
                    .swarm = SwarmPose{{{700, 400}, 0}, radar_radius},
                    .robots = {},
                    .world = borrowed(world)},
                   {});
    if (navigator.view().planned) planned.push_back(now);
  }
  ASSERT_EQ(planned.size(), 9u);  // 0, 1, 3, 7, 15, 31, 61, 91 and 121 s
  EXPECT_NEAR(planned[1], 1, 0.11);
  EXPECT_NEAR(planned[3], 7, 0.5);
}

TEST(Radar, PlansFromBesideAWallItIsSeenTooNearTo) {
  // 3 µm nearer to the wall below than the swarm is wide, as noise may show it.
  const auto map = halved_room(1000);
  RadarParams params;
  params.global_plan = true;
  RadarNavigator navigator(params, body_task(radar_vortex, {2300, 400}, 20),
                           Rng(1, Purpose::planner));
  const Snapshot world(map, 0);
  const Command c = navigator.step({.now = 0,
                                    .seen = 0,
                                    .swarm = SwarmPose{{{700, radar_radius - 3}, 0}, radar_radius},
                                    .robots = {},
                                    .world = borrowed(world)},
                                   {});
  EXPECT_NE(navigator.view().state, NavigatorState::stuck);
  EXPECT_GT(c.speed, 0);
}

TEST(Radar, LeavesAWallThatIsNearerThanItsSafetyDistance) {
  // Every step of 25 µm ends nearer to the border than r_s + d_f.
  RadarParams params;
  params.safety_distance = 80;
  params.detection_range = 120;
  const Trip trip = drive(params, {700, radar_radius + 5}, {2300, 700}, radar_room(), nothing);
  EXPECT_TRUE(trip.arrived);
  EXPECT_TRUE(trip.was(NavigatorState::retreat));
}

TEST(Radar, TellsItsPhasedGoal) {
  const Snapshot world(halved_room(1000), 0);
  RadarParams params;
  params.waypoints = {{1300, 1250}, {1600, 1250}};
  RadarNavigator navigator(params, body_task(radar_vortex, {2300, 400}, 20),
                           Rng(1, Purpose::planner));
  Observation seen{.now = 0,
                   .seen = 0,
                   .swarm = SwarmPose{{{700, 400}, 0}, radar_radius},
                   .robots = {},
                   .world = borrowed(world)};
  navigator.step(seen, {});
  EXPECT_EQ(navigator.view().phased_goal, (Vec2{1300, 1250}));
  seen.now = seen.seen = 0.1;
  seen.swarm.reset();  // also while it sees nothing
  navigator.step(seen, {});
  EXPECT_EQ(navigator.view().phased_goal, (Vec2{1300, 1250}));
}

TEST(Radar, WaitsForAValve) {
  // A passage of 600 µm; the valve is closed for some time, and the swarm must not be touched.
  const auto map = radar_room({scenes::rectangle({{1400, 0}, {1600, 450}}),
                               scenes::rectangle({{1400, 1050}, {1600, 1500}})});
  const Obstacle valve{Valve{.span = 600, .thickness = 60, .max_gap = 500, .period = 40},
                       Still{.position = {1500, 750}}};
  const auto leaves = [&](double t) {
    std::vector<Body> bodies;
    append_bodies(valve, 0, t, bodies);
    return bodies;
  };
  RadarParams params;
  params.safety_distance = 15;
  params.wait_zones = {{.centre = {1500, 750}, .width = 700, .height = 700, .min_gap = 400}};
  for (const double begin : {0.0, 7.0, 13.0, 20.0, 26.0, 33.0}) {
    const Trip trip =
        drive(params, {900, 750}, {2300, 750}, map, [&](double t) { return leaves(t + begin); });
    EXPECT_TRUE(trip.arrived) << begin;
    EXPECT_GT(trip.min_gap, 0) << begin;
  }
}

TEST(Radar, MakesUpForDelays) {
  // Seen 0.2 s late, obeyed 0.3 s late: it decides for the place it will have got to.
  SwarmLimits slow = radar_vortex;
  slow.response_lag = 0.3;
  const Snapshot world(radar_room(), 0);
  RadarNavigator navigator({}, body_task(slow, {2700, 700}, 20), Rng(1, Purpose::planner));
  for (int k = 0; k < 20; ++k) {
    const double now = radar_tick * k;
    navigator.step({.now = now,
                    .seen = now - 0.2,
                    .swarm = SwarmPose{{{500, 700}, 0}, radar_radius},
                    .robots = {},
                    .world = borrowed(world)},
                   {});
  }
  ASSERT_TRUE(navigator.last_look());
  EXPECT_NEAR(navigator.last_look()->centre.x, 500 + 0.5 * 85, 1e-9);
}

TEST(Radar, LastLookGivesTheDecisionInFull) {
  const Snapshot world(radar_room(), 0, {disc_body({1700, 700}, 80, 3)});
  RadarNavigator navigator({}, body_task(radar_vortex, {2700, 700}, 20), Rng(1, Purpose::planner));
  EXPECT_FALSE(navigator.last_look());
  const Command c = navigator.step({.now = 0,
                                    .seen = 0,
                                    .swarm = SwarmPose{{{1500, 700}, 0}, radar_radius},
                                    .robots = {},
                                    .world = borrowed(world)},
                                   {});
  ASSERT_TRUE(navigator.last_look());
  const RadarDiagnostics decision = scan(*navigator.last_look(), world, 360);
  ASSERT_TRUE(decision.best);
  EXPECT_EQ(decision.beams.size(), 360u);
  EXPECT_EQ(decision.beams[*decision.best].heading, c.heading);
  EXPECT_EQ(decision.beams[0].fate, BeamFate::obstacle);
  EXPECT_EQ(decision.beams[0].obstacle, 3u);
}

TEST(Radar, WaypointsInAWallAreRefused) {
  const auto map = radar_room({scenes::rectangle({{1400, 0}, {1450, 1000}})});
  RadarParams params;
  params.waypoints = {{500, 500}, {1420, 500}};
  const Task task = body_task(radar_vortex, {2300, 400}, 20);
  const Issues issues = validate(params, task, *map);
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues.begin()->keys.front(), "waypoints_um.1");
  EXPECT_EQ(issues.begin()->text, "waypoint 2 is 20 µm inside wall 1");
  params.waypoints.pop_back();
  EXPECT_TRUE(validate(params, task, *map).empty());
  params.waypoints.front() = {1420, 500};
  EXPECT_EQ(validate(params, task, *map).size(), 1u);
}

}  // namespace
}  // namespace microswarm::navigation
