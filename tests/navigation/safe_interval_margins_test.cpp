// SPDX-License-Identifier: Apache-2.0
// Margins of the safe-interval navigator for what it cannot know exactly.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "microswarm/navigation/safe_interval/imminent_check.hpp"
#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"
#include "microswarm/navigation/safe_interval/safe_interval.hpp"
#include "tests/navigation/late_drive.hpp"

namespace microswarm::navigation {
namespace {

constexpr double frame_time = 0.1;  // [s]

/// Frames of an open place with obstacles, and a swarm at rest that strays by `error` µm from frame
/// to frame.
struct Seen {
  std::vector<Obstacle> obstacles{};
  double error = 0;
  double delay = 0;
  double noise = 0;   ///< of the obstacles' positions
  Vec2 at{200, 500};  ///< where the swarm is seen
  Rng walk{5, Purpose::test};
  Rng rng{7, Purpose::test};
  int frames = 0;
  SafeIntervalParams params{};
  MultiModelPredictor predictor{params.prediction};
  std::shared_ptr<const Map> map =
      std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, std::vector<Polygon>{});

  Snapshot next() {
    const double t = frame_time * frames++;
    std::vector<Body> bodies;
    for (std::uint32_t i = 0; i < obstacles.size(); ++i) append_bodies(obstacles[i], i, t, bodies);
    for (Body& body : bodies) {
      const double dx = rng.normal(), dy = rng.normal();
      shift(body, noise * Vec2{dx, dy});
    }
    return Snapshot(map, t, std::move(bodies));
  }
  Observation observe(const Snapshot& frame) {
    const double dx = walk.normal(), dy = walk.normal();
    at = at + error * Vec2{dx, dy};
    return {.now = frame.time() + delay,
            .seen = frame.time(),
            .swarm = SwarmPose{{at, 0}, 50},
            .robots = {},
            .world = borrowed(frame)};
  }
};

/// A way with a turn after every 0.9 to 1.5 s, which no motion model repeats.
Obstacle turning_disc() {
  Waypoints way{.points = {{1000, 500}}, .speed = 60, .at_end = AtEnd::stay};
  Rng rng(3, Purpose::test);
  for (int k = 0; k < 40; ++k)
    way.points.push_back(way.points.back() +
                         rng.uniform(54, 90) * unit_vector(rng.uniform(-pi, pi)));
  return {DiscShape{40}, way};
}

TEST(SafeIntervalMargins, TheGapFromWhatTurnsWithoutNoticeIsTheWayUntilTheAnswer) {
  for (const double delay : {0.0, 0.4}) {
    Seen seen{.obstacles = {{DiscShape{40}, Straight{{200, 200}, {60, 0}}}, turning_disc()},
              .delay = delay};
    ObstacleForecast forecast(seen.params, 80);
    for (int k = 0; k < 150; ++k) {
      const Snapshot frame = seen.next();
      seen.predictor.update(seen.observe(frame));
      forecast.update(frame, seen.predictor, frame.time() + delay, std::array{Vec2{200, 500}});
    }
    ASSERT_EQ(forecast.size(), 2u);
    const double way = 60 * (delay + seen.params.tuning.reaction_time);
    EXPECT_LT(forecast.turn_reach(0), 0.1 * way) << "it has always gone straight";
    EXPECT_NEAR(forecast.turn_reach(1), way, 0.2 * way);
    const double known = seen.params.gap + forecast.noise(1) + forecast.at(0, 1).uncertainty;
    EXPECT_NEAR(forecast.gap(0, 1), known + 0.7 * forecast.turn_reach(1), 1e-9);
  }
}

TEST(SafeIntervalMargins, NoiseHidesATurnForLonger) {
  Seen seen{.obstacles = {turning_disc()}, .noise = 6};
  ObstacleForecast forecast(seen.params, 80);
  for (int k = 0; k < 100; ++k) {
    const Snapshot frame = seen.next();
    seen.predictor.update(seen.observe(frame));
    forecast.update(frame, seen.predictor, frame.time(), std::array{Vec2{200, 500}});
  }
  ASSERT_GT(forecast.noise(0), 3);
  const double way = seen.params.tuning.reaction_time * norm(seen.predictor.tracked(0).velocity);
  EXPECT_NEAR(forecast.turn_reach(0), way + 2 * forecast.noise(0), 1);
}

// At a sample the disc is on one side of the swarm, at the next one on the other.
TEST(SafeIntervalMargins, WhatCrossesBetweenTwoSamplesIsMet) {
  constexpr int sample = 4;
  constexpr Vec2 swarm{600, 500};
  Seen seen{.obstacles = {{DiscShape{10}, Straight{{600, -775}, {0, 1200}}}}};
  ObstacleForecast forecast(seen.params, 80);
  for (int k = 0; k < 6; ++k) {
    const Snapshot frame = seen.next();
    seen.predictor.update(seen.observe(frame));
    forecast.update(frame, seen.predictor, frame.time(), std::array{Vec2{200, 500}});
  }
  forecast.predict_all(seen.predictor);
  EXPECT_LT(forecast.at(sample, 0).centre.y, swarm.y - 70);
  EXPECT_GT(forecast.at(sample + 1, 0).centre.y, swarm.y + 70);
  EXPECT_LT(forecast.gap_along({swarm, swarm}, sample, 0, 20, 1e3), 0);
}

TEST(SafeIntervalMargins, ANewObstacleMayTurn) {
  Seen seen{.obstacles = {{DiscShape{40}, Straight{{200, 200}, {60, 0}}}}};
  for (int k = 0; k < 3; ++k) {
    const Snapshot frame = seen.next();
    seen.predictor.update(seen.observe(frame));
  }
  EXPECT_EQ(seen.predictor.surprise(0), 1);
}

// The swarm is commanded to stay and is seen to move: the radius in its gaps grows by that.
TEST(SafeIntervalMargins, GapsGrowByHowFarTheSwarmIsFromWhereItShouldBe) {
  const auto radius = [](double error) {
    Seen seen{.obstacles = {{DiscShape{40}, Still{{1500, 500}, 0}}}, .error = error};
    SafeIntervalParams params;
    SafeIntervalNavigator navigator(params, body_task(slow_vortex), Rng(1, Purpose::planner));
    navigator.prepare(seen.next(), {});
    double shown = 0;
    for (int k = 0; k < 100; ++k) {
      const Snapshot frame = seen.next();
      navigator.step(seen.observe(frame), {});
      navigator.overruled(frame.time(), {0, 0});
      shown = std::get<PredictiveDiagnostics>(navigator.diagnostics()).radius;
    }
    return shown;
  };
  EXPECT_NEAR(radius(0), 50, 1e-6);
  EXPECT_NEAR(radius(4), 50 + 1.5 * 4, 1.2);
}

// A fast disc comes from below towards a swarm beside a wall; a contact cannot be avoided.
TEST(SafeIntervalMargins, InContactItDoesNotRunIntoAWall) {
  const std::vector<Polygon> walls{{{{0, 555}, {2000, 555}, {2000, 1000}, {0, 1000}}, {}}};
  Seen seen{.obstacles = {{DiscShape{300}, Straight{{200, 100}, {0, 200}}}}};
  seen.map = std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, walls);
  SafeIntervalNavigator navigator({}, body_task(slow_vortex), Rng(1, Purpose::planner));
  navigator.prepare(seen.next(), {});
  for (int k = 0; k < 20; ++k) {
    const Snapshot frame = seen.next();
    const Command command = navigator.step(seen.observe(frame), {});
    const Vec2 at{200, 500};
    const Segment next{at, at + 0.12 * command.speed * unit_vector(command.heading)};
    EXPECT_TRUE(seen.map->is_free(next, 50)) << k << ": " << degrees(command.heading);
    navigator.overruled(frame.time(), {0, 0});
  }
}

TEST(SafeIntervalMargins, LeavesOfAValveAreExpectedBack) {
  const Valve valve{
      .span = 200, .thickness = 30, .min_gap = 0, .max_gap = 300, .period = 10, .phase = 0};
  Seen seen{.obstacles = {{valve, Still{{1000, 500}, 0}}}};
  ObstacleForecast forecast(seen.params, 80);
  int unseen = 0;
  for (int k = 0; k < 200; ++k) {
    const Snapshot frame = seen.next();
    seen.predictor.update(seen.observe(frame));
    forecast.update(frame, seen.predictor, frame.time(), std::array{Vec2{200, 500}});
    if (k < 100 || !frame.moving().empty()) continue;
    ++unseen;
    ASSERT_EQ(forecast.size(), 2u) << k;
    forecast.predict_all(seen.predictor);
    bool comes_back = false;
    for (int s = 0; s < forecast.samples(); ++s) comes_back |= forecast.at(s, 0).growth > 20;
    EXPECT_TRUE(comes_back) << k;
    EXPECT_TRUE(forecast.diagnostics(50).bodies.empty());
  }
  EXPECT_GT(unseen, 20);
}

const std::vector<Polygon> corridor{{{{300, 0}, {1700, 0}, {1700, 420}, {300, 420}}, {}},
                                    {{{300, 580}, {1700, 580}, {1700, 1000}, {300, 1000}}, {}}};

// In a corridor that the disc fills; it turns round in no time, without notice.
TEST(SafeIntervalMargins, NothingIsFollowedSoCloselyThatItsTurnHits) {
  for (const double speed : {45.0, 50.0, 55.0})
    for (const double end : {1000.0, 1257.0, 1300.0}) {
      const Waypoints way{{{450, 500}, {end, 500}, {450, 500}}, speed, AtEnd::stay};
      LateDrive<SafeIntervalNavigator> drive{.walls = corridor,
                                             .obstacles = {{DiscShape{45}, way}}};
      drive.run(end / speed);
      EXPECT_GT(drive.min_gap, 3) << speed << ", " << end;
    }
}

// Noise hides its turn for longer.
TEST(SafeIntervalMargins, NothingThatIsSeenWithNoiseIsFollowedSoClosely) {
  for (const double speed : {30.0, 45.0, 60.0})
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const double end = 1100 + 40.0 * static_cast<double>(seed);
      const Waypoints way{{{450, 500}, {end, 500}, {450, 500}}, speed, AtEnd::stay};
      LateDrive<SafeIntervalNavigator> drive{
          .walls = corridor, .obstacles = {{DiscShape{45}, way}}, .noise = 2, .seed = seed};
      drive.run((end - 450) / speed + 10);
      EXPECT_GT(drive.min_gap, 0) << speed << ", " << seed;
    }
}

TEST(SafeIntervalMargins, ASwarmThatFramesMissIsWhereItsCommandsTookIt) {
  LateDrive<SafeIntervalNavigator> drive;
  drive.is_missed = [](int frame) { return frame % 4 >= 2; };
  drive.run(40);
  EXPECT_TRUE(drive.arrived);
  EXPECT_FALSE(drive.was(NavigatorState::blind));
  EXPECT_LT(drive.time, 1600 / 70.0 + 1);
}

TEST(SafeIntervalMargins, ASwarmThatIsLostIsHeld) {
  LateDrive<SafeIntervalNavigator> drive;
  drive.is_missed = [](int frame) { return frame >= 20; };
  drive.run(4);
  const double lost = frame_time * 20;
  for (std::size_t k = 0; k < drive.commands.size(); ++k) {
    const double t = frame_time * static_cast<double>(k);
    if (t > lost + default_frame_timeout + frame_time) {
      EXPECT_EQ(drive.states[k], NavigatorState::blind) << t;
      EXPECT_EQ(drive.commands[k].speed, 0) << t;
    } else if (t < lost + default_frame_timeout - 2 * frame_time) {
      EXPECT_EQ(drive.states[k], NavigatorState::follow) << t;
    }
  }
}

/// A wall from below, whose upper end is above the straight way.
const std::vector<Polygon> wall_in_the_way{{{{980, 0}, {1020, 0}, {1020, 620}, {980, 620}}, {}}};

// The estimate of a swarm that is seen with noise errs by some µm: the gap to walls is more by
// that.
TEST(SafeIntervalMargins, TheNoiseOfTheSwarmKeepsItFromWalls) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}) {
    LateDrive<SafeIntervalNavigator> drive{
        .walls = wall_in_the_way, .seed = seed, .swarm_noise = 9};
    drive.run(60);
    EXPECT_TRUE(drive.arrived) << seed;
    EXPECT_GT(drive.min_gap, 0) << seed;
  }
}

TEST(SafeIntervalMargins, AFlowDoesNotCarryItIntoAWall) {
  for (const SwarmLimits& swarm : {slow_vortex, slow_ribbon})
    for (const Vec2 flow : {Vec2{0, -15}, Vec2{-10, -10}, Vec2{15, 0}}) {
      LateDrive<SafeIntervalNavigator> drive{
          .walls = wall_in_the_way, .swarm = swarm, .flow = flow};
      drive.run(60);
      EXPECT_TRUE(drive.arrived) << flow.x << ", " << flow.y;
      EXPECT_GT(drive.min_gap, 0) << flow.x << ", " << flow.y;
    }
}

// It faces a disc that fills the corridor and must turn round there, beside the walls.
TEST(SafeIntervalMargins, ASlowTurnerTurnsRoundInACorridor) {
  for (const double rate : {1.0, 1.5, 2.0})
    for (const double from : {900.0, 1000.0, 1100.0}) {
      LateDrive<SafeIntervalNavigator> drive{
          .walls = corridor,
          .obstacles = {{DiscShape{45}, Straight{{from, 500}, {-45, 0}}}},
          .swarm = {50, 70, rate, 0.1},
          .pose = {{600, 500}, 0}};
      drive.run(30);
      EXPECT_GT(drive.min_gap, 0) << rate << ", " << from;
    }
}

// Between walls whose ends lie above and below the straight way, it turns by more than a right
// angle at each.
TEST(SafeIntervalMargins, ASlowTurnerTurnsInAFlow) {
  const std::vector<Polygon> slalom{{{{700, 0}, {740, 0}, {740, 820}, {700, 820}}, {}},
                                    {{{940, 180}, {980, 180}, {980, 1000}, {940, 1000}}, {}}};
  for (const Vec2 flow : {Vec2{}, Vec2{0, -12}, Vec2{0, 12}, Vec2{-10, 5}}) {
    LateDrive<SafeIntervalNavigator> drive{
        .walls = slalom, .swarm = {50, 70, 1.5, 0.1}, .flow = flow};
    drive.run(90);
    EXPECT_TRUE(drive.arrived) << flow.x << ", " << flow.y;
    EXPECT_LT(drive.time, 55) << flow.x << ", " << flow.y;
    EXPECT_GT(drive.min_gap, 0) << flow.x << ", " << flow.y;
  }
}

TEST(SafeIntervalMargins, ACommandToTurnHasTheHeadingOfTheMoveInAFlow) {
  const SwarmResponse response{1, {0, -15}};
  const Command move = response.command_for({0, 70}, 70);
  EXPECT_NEAR(move.heading, std::asin(15.0 / 70), 1e-9);
  const double slow = planning::TurnFirst::slow_share * 70;
  const Command turn = response.command_for({0, slow}, 70);
  EXPECT_EQ(turn.heading, move.heading);
  EXPECT_EQ(turn.speed, slow);
}

TEST(SafeIntervalMargins, AStayLastsUntilItsEnd) {
  KeptPlan plan(10);
  plan.adopt(std::vector<planning::TimedPoint>{{{0, 0}, 0}, {{50, 0}, 5}, {{50, 0}, 16}}, 100, 7);
  EXPECT_TRUE(plan.ends_in_stay());
  EXPECT_FALSE(plan.is_stay());
  EXPECT_NEAR(plan.duration({{0, 0}, 0}, 100), 16, 1e-9);
  plan.advance({50, 0}, 1, 105);
  EXPECT_TRUE(plan.is_stay());
  EXPECT_NEAR(plan.wait(105), 11, 1e-9);
  plan.advance({50, 0}, 1, 115.9);
  EXPECT_TRUE(plan.is_stay());
  plan.advance({50, 0}, 1, 116);
  EXPECT_TRUE(plan.empty());
}

/// Discs that close in on a swarm that turns slowly, and a check of its next seconds.
struct Closing {
  SafeIntervalParams params{.horizon = 2 * ObstacleForecast::slots * frame_time};
  SwarmLimits swarm{.radius = 50, .max_speed = 70, .max_turn_rate = 1.5};
  Snapshot room = room_with();
  Seen seen{};
  ObstacleForecast forecast{params, swarm.max_speed};
  ImminentCheck check{params.tuning.imminent, swarm, swarm.max_speed, frame_time};
  Pose2 pose{};

  void begin() {
    const Snapshot frame = seen.next();
    seen.predictor.update(seen.observe(frame));
    forecast.update(frame, seen.predictor, frame.time(), std::array{pose.position});
    forecast.measure_from(pose.position, swarm.radius);
    check.begin({.map = &room.map(),
                 .forecast = &forecast,
                 .pose = pose,
                 .radius = swarm.radius,
                 .wall_clearance = 52,
                 .goal = {{1800, 500}, 30},
                 .response = {},
                 .time = frame.time()});
  }
};

// One tick after a safe command, the escape with which it was safe can be continued.
TEST(SafeIntervalMargins, TheEscapeOfASafeCommandIsKept) {
  Rng rng(11, Purpose::test);
  int safe = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Closing c;
    c.pose = {{500, 500}, rng.uniform(-pi, pi)};
    for (int k = 0; k < 6; ++k) {
      const double from = rng.uniform(-pi, pi);
      const Vec2 at = c.pose.position + rng.uniform(200, 340) * unit_vector(from);
      const double course = from + pi + rng.uniform(-0.4, 0.4);
      c.seen.obstacles.push_back(
          {DiscShape{40}, Straight{at, rng.uniform(30, 60) * unit_vector(course)}});
    }
    for (int k = 0; k < 15; ++k) c.begin();
    for (int k = 0; k < 20; ++k) {
      const Command command{rng.uniform(-pi, pi), 70};
      if (!c.check.is_safe(command)) continue;
      ++safe;
      c.pose = unicycle_step(c.pose, command, c.swarm.max_turn_rate, frame_time);
      c.begin();
      if (c.forecast.min_current_gap() < 5) break;
      EXPECT_TRUE(c.check.kept_escape().has_value()) << trial << ", " << k;
    }
  }
  EXPECT_GT(safe, 100);
}

// Where the commands towards the wanted heading are not safe, it turns by 2 rad nearly in place.
TEST(SafeIntervalMargins, WhereATurnIsNotSafeItTurnsOneWayOrTheOther) {
  Rng rng(12, Purpose::test);
  int turned = 0;
  for (int trial = 0; trial < 300 && turned < 2; ++trial) {
    Closing c;
    c.pose = {{500, 500}, rng.uniform(-pi, pi)};
    const double side = trial % 2 == 0 ? 1 : -1;
    for (int k = 0; k < 6; ++k) {
      const double from = c.pose.heading + side * rng.uniform(0.3, 3);
      const Vec2 at = c.pose.position + rng.uniform(150, 340) * unit_vector(from);
      const double course = from + pi + rng.uniform(-0.6, 0.6);
      c.seen.obstacles.push_back(
          {DiscShape{40}, Straight{at, rng.uniform(30, 60) * unit_vector(course)}});
    }
    for (int k = 0; k < 15; ++k) c.begin();
    const Command wanted{wrap(c.pose.heading + 2.6 * side), 70};
    const auto chosen = c.check.nearest_safe(wanted, {c.pose.heading, 0});
    if (!chosen || !planning::TurnFirst::is_turn(chosen->speed, 70) || chosen->speed == 0) continue;
    if (std::abs(turn_between(chosen->heading, c.pose.heading) - 2) > 1e-9) continue;
    ++turned;
    EXPECT_TRUE(c.check.is_safe(*chosen)) << trial;
  }
  EXPECT_EQ(turned, 2);
}

// A swarm 10 µm before the gap to the lower side of the room.
TEST(SafeIntervalMargins, AMoveIsCheckedAsTheFlowLetsItBe) {
  const SafeIntervalParams params;
  const SwarmLimits swarm{.radius = 50, .max_speed = 40, .max_turn_rate = infinity};
  const Snapshot room = room_with();
  ObstacleForecast forecast(params, swarm.max_speed);
  forecast.update(room, MultiModelPredictor(params.prediction), 0, std::array{Vec2{500, 62}});
  forecast.measure_from({500, 62}, swarm.radius);
  ImminentCheck check(params.tuning.imminent, swarm, swarm.max_speed, frame_time);
  const auto is_safe = [&](const Command& command, Vec2 flow) {
    check.begin({.map = &room.map(),
                 .forecast = &forecast,
                 .pose = {{500, 62}, 0},
                 .radius = swarm.radius,
                 .wall_clearance = 52,
                 .goal = {{1800, 500}, 30},
                 .response = {1, flow}});
    return check.is_safe(command);
  };
  const Command hold{0, 0}, along{0, 40};
  for (const Command& command : {hold, along}) EXPECT_TRUE(is_safe(command, {}));
  EXPECT_TRUE(is_safe(along, {0, -20})) << "it can go against the flow";
  EXPECT_FALSE(is_safe(along, {0, -200})) << "the flow carries it into the wall";
  EXPECT_FALSE(is_safe(hold, {0, -200})) << "so it does where it holds";
}

}  // namespace
}  // namespace microswarm::navigation
